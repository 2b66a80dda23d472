#include "incognita/analysis/systems/motion_inputs.hpp"

#include <algorithm>

namespace incognita {
namespace {

using GiNaC::ex;
using Slot = SymbolicSystem::Slot;

/// The quantities that a value depends on.
class Names {
 public:
  Names(const ExpressionGraph& graph, Slot value) : needed_(graph.needed_for({value})) {}
  bool any_of(const std::vector<Slot>& slots) const {
    return std::any_of(slots.begin(), slots.end(),
                       [&](Slot s) { return needed_[static_cast<std::size_t>(s)]; });
  }

 private:
  std::vector<bool> needed_;
};

/// Classifies unassigned inputs first, then the assigned ones in evaluation order, so that an assignment's
/// dependencies are classified before it.
class Sorter {
 public:
  explicit Sorter(const SymbolicSystem& system) : system_(system) {}

  MotionInputs run() {
    for (std::size_t i = 0; i < system_.inputs.size(); ++i)
      if (!is_assigned(system_.inputs[i])) sort_unassigned(system_.inputs[i], system_.input_ranges[i]);
    for (const auto& assignment : system_.assignments)
      if (assignment.to_input) sort_assigned(assignment);
    std::sort(inputs_.held.begin(), inputs_.held.end());  // order of the file
    return std::move(inputs_);
  }

 private:
  bool is_assigned(Slot input) const {
    return std::any_of(system_.assignments.begin(), system_.assignments.end(),
                       [&](const auto& a) { return a.target == input; });
  }

  void sort_unassigned(Slot input, const NamedRange& range) {
    if (range.low < range.high)
      varying_.push_back(input), inputs_.free.push_back(input);
    else if (range.low == 0)
      inputs_.zero[system_.graph[input].symbol] = 0;
    else
      inputs_.held.push_back(input);
  }

  void sort_assigned(const SymbolicSystem::Assignment& a) {
    if (system_.graph[a.value].expression->is_zero()) {
      inputs_.zero[system_.graph[a.target].symbol] = 0;
      return;
    }
    const Names names(system_.graph, a.value);
    const bool varies = names.any_of(varying_);
    if (varies) varying_.push_back(a.target);
    const bool mixed = varies && (names.any_of(system_.draws) || names.any_of(system_.vehicle.states) ||
                                  names.any_of(mixed_));
    if (mixed) mixed_.push_back(a.target);
    if (varies && !mixed)
      inputs_.tied.push_back(a);
    else
      inputs_.held.push_back(a.target);
    inputs_.mixed = inputs_.mixed || mixed;
  }

  const SymbolicSystem& system_;
  MotionInputs inputs_;
  std::vector<Slot> varying_;  // free, or set from a free one
  std::vector<Slot> mixed_;
};

}  // namespace

MotionInputs motion_inputs(const SymbolicSystem& system) { return Sorter(system).run(); }

bool inputs_affine_in_draws(const SymbolicSystem& system) {
  std::vector<Slot> drawn = system.draws;  // and inputs that are set from draws
  for (const auto& a : system.assignments) {
    const Names names(system.graph, a.value);
    if (!a.to_input || !names.any_of(drawn)) continue;
    if (!system.graph.is_affine_in(*system.graph[a.value].expression, drawn)) return false;
    drawn.push_back(a.target);
  }
  return true;
}

}  // namespace incognita
