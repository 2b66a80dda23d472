// What Lie derivatives say of a system; lie_derivatives.hpp computes it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/observability/null_space.hpp"

namespace incognita {

struct LieSettings {
  int max_order = 10;
};

/// One derivative of one measurement: the same expression for each landmark.
struct LieRow {
  std::string name;   ///< "L_v L_0 bearing"
  std::string owner;  ///< "vehicle", "landmark" or "anchor"
  int order = 0;
  std::string expression;                                        ///< of the derivative, in named parts
  std::vector<std::pair<std::string, std::string>> definitions;  ///< of the parts that are not the file's own
  std::string latex;                                             ///< "\mathcal{L}_{v} x = ..."
  std::vector<std::string> latex_definitions;                    ///< of all parts, likewise
  bool raised_rank = false;
};

struct LieAnalysis {
  NullSpace space;                ///< at the start of the motion
  int order = 0;                  ///< highest that raised the rank
  int orders_examined = 0;        ///< highest that was computed
  bool closed = false;            ///< no further derivative can raise the rank; else the limit was hit
  bool missed = false;            ///< what the search took for nothing new may be something: not closed
  int generic_rank = 0;           ///< at a point of the region that no kind of motion restricts
  bool inputs_nonlinear = false;  ///< some fields are rates at drawn inputs
  std::vector<std::string> fields;
  std::vector<LieRow> rows;
};

}  // namespace incognita
