// A system in symbols: one vehicle, one landmark and one anchor, whatever their numbers.
#pragma once

#include <string>
#include <vector>

#include "incognita/analysis/systems/expression_graph.hpp"
#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

struct SymbolicSystem {
  using Slot = ExpressionGraph::Slot;

  /// Entry of a matrix. Columns: the states of the vehicle, then those of one landmark. Rows of F likewise;
  /// rows of H by measurement of their block.
  struct Entry {
    int row = 0;
    int column = 0;
    Slot value = 0;
  };

  struct Block {
    std::vector<Slot> states;        ///< for an anchor: its constants
    std::vector<NamedRange> region;  ///< in the order of the states
    std::vector<Slot> rates;         ///< empty for anchors
    std::vector<Slot> measurements;
    std::vector<double> sigmas;
    std::vector<Entry> error_F, error_H;
  };

  struct Direction {
    std::string name;
    bool each_landmark = false;  ///< one per landmark, which changes only that landmark
    std::vector<std::pair<int, Slot>> vehicle, landmark;  ///< state (from 0, in its block) and value
  };

  struct Assignment {
    Slot target = 0;  ///< a state of the vehicle, or an input
    bool to_input = false;
    Slot value = 0;
  };

  SystemText text;
  ExpressionGraph graph;
  Block vehicle, landmark, anchor;
  std::vector<Slot> inputs;
  std::vector<int> disturbed;  ///< states of the vehicle, from 0
  std::vector<NamedRange> input_ranges;
  std::vector<std::pair<Slot, double>> parameters;
  std::vector<Direction> directions, error_directions;
  std::vector<std::string> vehicle_error_names, landmark_error_names;
  std::string motion = "general";
  std::vector<Assignment> assignments;  ///< in evaluation order
  std::vector<Slot> draws;
  std::vector<NamedRange> draw_ranges;

  int columns() const { return static_cast<int>(vehicle.states.size() + landmark.states.size()); }
};

/// Throws SystemError, with the location in the file, for an invalid text; std::invalid_argument, listing the
/// known motions, for an unknown motion.
SymbolicSystem make_symbolic(const SystemText& text, const std::string& motion = "general");

}  // namespace incognita
