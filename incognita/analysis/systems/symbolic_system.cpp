#include "incognita/analysis/systems/symbolic_system.hpp"

#include <algorithm>
#include <stdexcept>

#include "incognita/analysis/systems/assignment_order.hpp"

namespace incognita {
namespace {

using Slot = SymbolicSystem::Slot;

/// Builds the system step by step; each step adds names for the next.
class SystemBuilder {
 public:
  explicit SystemBuilder(const SystemText& text) { system_.text = text; }

  SymbolicSystem make(const std::string& motion) {
    const SystemText& text = system_.text;
    for (const NamedNumber& p : text.parameters)
      system_.parameters.emplace_back(graph().add_atom(p.name, Owner::vehicle, p.location), p.value);
    for (const NamedRange& input : text.inputs) {
      system_.inputs.push_back(graph().add_atom(input.name, Owner::vehicle, input.location));
      system_.input_ranges.push_back(input);
    }
    add_block(text.vehicle, Owner::vehicle, system_.vehicle);
    if (text.landmark) add_block(*text.landmark, Owner::landmark, system_.landmark);
    if (text.anchor) add_block(*text.anchor, Owner::anchor, system_.anchor);
    for (const DisturbedState& d : text.disturbed) {
      system_.disturbed.push_back(index_of(d.name, text.vehicle));
      if (system_.disturbed.back() < 0)
        throw SystemError(d.location, "there is no state `" + d.name + "` of the vehicle to disturb");
    }
    add_matrices();
    for (const DirectionText& d : text.directions) system_.directions.push_back(direction(d, false));
    for (const DirectionText& d : text.landmark_directions) system_.directions.push_back(direction(d, true));
    add_error_form();
    add_motion(motion);
    return std::move(system_);
  }

 private:
  ExpressionGraph& graph() { return system_.graph; }

  Slot define(const std::string& name, Owner owner, const ExpressionText& expression) {
    return graph().define(name, owner, graph().parse(expression, owner), expression.location);
  }

  void add_block(const BlockText& text, Owner owner, SymbolicSystem::Block& block) {
    int column = static_cast<int>(owner == Owner::landmark ? system_.vehicle.states.size() : 0);
    block.region = ordered_region(text);
    for (const NamedRange& range : block.region)
      block.states.push_back(
          graph().add_atom(range.name, owner, range.location, owner == Owner::anchor ? -1 : column++));
    for (const NamedExpression& d : text.definitions)
      graph().define(d.name, owner, graph().parse(d.expression, owner), d.expression.location, true);
    for (const NamedExpression& s : text.states)
      block.rates.push_back(define("d " + s.name + "/dt", owner, s.expression));
    for (const MeasurementText& m : text.measurements) {
      block.measurements.push_back(define(m.name, owner, m.expression));
      block.sigmas.push_back(m.sigma);
    }
  }

  /// The region in the order of the states; anchors have no equations and keep their own order.
  static std::vector<NamedRange> ordered_region(const BlockText& text) {
    if (text.states.empty()) return text.region;
    std::vector<NamedRange> ordered;
    for (const NamedExpression& state : text.states) {
      const auto found = std::find_if(text.region.begin(), text.region.end(),
                                      [&](const NamedRange& r) { return r.name == state.name; });
      if (found == text.region.end())
        throw SystemError(state.location, "state `" + state.name + "` has no region to draw it from");
      ordered.push_back(*found);
    }
    return ordered;
  }

  static int index_of(const std::string& name, const BlockText& block) {
    const auto found = std::find_if(block.states.begin(), block.states.end(),
                                    [&](const NamedExpression& s) { return s.name == name; });
    return found == block.states.end() ? -1 : static_cast<int>(found - block.states.begin());
  }

  /// Column of a state among the vehicle's states and those of one landmark.
  int column_of(const std::string& name, SourceLocation location) const {
    const SystemText& text = system_.text;
    const int own = index_of(name, text.vehicle);
    if (own >= 0) return own;
    const int theirs = text.landmark ? index_of(name, *text.landmark) : -1;
    if (theirs < 0) throw SystemError(location, "there is no state `" + name + "`");
    return static_cast<int>(text.vehicle.states.size()) + theirs;
  }

  static int measurement_of(const SparseRow& row, const BlockText& block) {
    const auto found = std::find_if(block.measurements.begin(), block.measurements.end(),
                                    [&](const MeasurementText& m) { return m.name == row.name; });
    if (found == block.measurements.end())
      throw SystemError(row.location, "there is no measurement `" + row.name + "` here");
    return static_cast<int>(found - block.measurements.begin());
  }

  void add_matrices(const BlockText& text, Owner owner, SymbolicSystem::Block& block) {
    for (const SparseRow& row : text.error_F)
      for (const NamedExpression& entry : row.entries)
        block.error_F.push_back({column_of(row.name, row.location), column_of(entry.name, entry.location),
                                 define("F_" + row.name + "_" + entry.name, owner, entry.expression)});
    for (const SparseRow& row : text.error_H)
      for (const NamedExpression& entry : row.entries)
        block.error_H.push_back({measurement_of(row, text), column_of(entry.name, entry.location),
                                 define("H_" + row.name + "_" + entry.name, owner, entry.expression)});
  }

  void add_matrices() {
    const SystemText& text = system_.text;
    add_matrices(text.vehicle, Owner::vehicle, system_.vehicle);
    if (text.landmark) add_matrices(*text.landmark, Owner::landmark, system_.landmark);
    if (text.anchor) add_matrices(*text.anchor, Owner::anchor, system_.anchor);
  }

  SymbolicSystem::Direction direction(const DirectionText& text, bool each_landmark) {
    SymbolicSystem::Direction direction{text.name, each_landmark, {}, {}};
    for (const NamedExpression& e : text.vehicle)
      direction.vehicle.emplace_back(index_of(e.name, system_.text.vehicle),
                                     define(text.name + " " + e.name, Owner::vehicle, e.expression));
    for (const NamedExpression& e : text.landmark)
      direction.landmark.emplace_back(index_of(e.name, *system_.text.landmark),
                                      define(text.name + " " + e.name, Owner::landmark, e.expression));
    return direction;
  }

  void add_error_form() {
    const SystemText& text = system_.text;
    for (const NamedExpression& s : text.vehicle.states) system_.vehicle_error_names.push_back(s.name);
    if (text.landmark)
      for (const NamedExpression& s : text.landmark->states) system_.landmark_error_names.push_back(s.name);
    if (!text.error_form) return;
    for (const NamedExpression& renamed : text.error_form->names) {
      for (std::size_t i = 0; i < text.vehicle.states.size(); ++i)
        if (text.vehicle.states[i].name == renamed.name)
          system_.vehicle_error_names[i] = renamed.expression.text;
      for (std::size_t i = 0; text.landmark && i < text.landmark->states.size(); ++i)
        if (text.landmark->states[i].name == renamed.name)
          system_.landmark_error_names[i] = renamed.expression.text;
    }
    for (const DirectionText& d : text.error_form->directions)
      system_.error_directions.push_back(direction(d, false));
    for (const DirectionText& d : text.error_form->landmark_directions)
      system_.error_directions.push_back(direction(d, true));
  }

  void add_motion(const std::string& name) {
    system_.motion = name;
    const auto& motions = system_.text.motions;
    const auto found =
        std::find_if(motions.begin(), motions.end(), [&](const MotionText& m) { return m.name == name; });
    if (found == motions.end()) {
      if (name == "general") return;
      std::string known = "general";
      for (const MotionText& m : motions) known += ", " + m.name;
      throw std::invalid_argument("`" + system_.text.name + "` has no motion `" + name + "`; it has " +
                                  known);
    }
    for (const NamedRange& draw : found->draws) {
      system_.draws.push_back(graph().add_atom(draw.name, Owner::motion, draw.location));
      system_.draw_ranges.push_back(draw);
    }
    for (const NamedExpression& a : found->assignments) add_assignment(a);
    system_.assignments = in_order_of_evaluation(graph(), system_.assignments);
  }

  void add_assignment(const NamedExpression& a) {
    const auto target = graph().find(a.name, Owner::vehicle);
    const auto is = [&](const std::vector<Slot>& slots) {
      return target && std::find(slots.begin(), slots.end(), *target) != slots.end();
    };
    const bool input = is(system_.inputs);
    if (!input && !is(system_.vehicle.states))
      throw SystemError(a.location,
                        "a motion sets inputs and states of the vehicle; `" + a.name + "` is neither");
    system_.assignments.push_back({*target, input, define("motion " + a.name, Owner::motion, a.expression)});
  }

  SymbolicSystem system_;
};

}  // namespace

SymbolicSystem make_symbolic(const SystemText& text, const std::string& motion) {
  return SystemBuilder(text).make(motion);
}

}  // namespace incognita
