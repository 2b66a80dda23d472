#include "incognita/analysis/systems/lie_algebra.hpp"

#include <algorithm>

#include "incognita/analysis/systems/motion_inputs.hpp"

namespace incognita {
namespace {

using GiNaC::ex;
using Slot = ExpressionGraph::Slot;

/// Rates of the states of vehicle and landmark.
std::map<Slot, Slot> rates_of(const SymbolicSystem& system) {
  std::map<Slot, Slot> rates;
  for (const auto* block : {&system.vehicle, &system.landmark})
    for (std::size_t i = 0; i < block->rates.size(); ++i) rates[block->states[i]] = block->rates[i];
  return rates;
}

bool is_atomic(const ex& e) { return GiNaC::is_a<GiNaC::numeric>(e) || GiNaC::is_a<GiNaC::symbol>(e); }

}  // namespace

LieAlgebra::LieAlgebra(const SymbolicSystem& system, int other_inputs) : system_(system) {
  add_fields(other_inputs);
}

bool LieAlgebra::is_linear_in(const std::vector<Slot>& inputs) const {
  for (const auto& [state, rate] : rates_of(system_))
    if (!system_.graph.is_affine_in(*system_.graph[rate].expression, inputs)) return false;
  return true;
}

bool LieAlgebra::moves_with(const std::vector<Slot>& inputs) const {
  for (const auto& [state, rate] : rates_of(system_))
    for (const Slot input : inputs)
      if (!system_.graph.derivative(*system_.graph[rate].expression, input).is_zero()) return true;
  return false;
}

std::vector<Slot> LieAlgebra::measurements() const {
  std::vector<Slot> all;
  for (const auto* block : {&system_.vehicle, &system_.landmark, &system_.anchor})
    all.insert(all.end(), block->measurements.begin(), block->measurements.end());
  return all;
}

/// Extends a substitution of inputs to all quantities that depend on them: rates and measurements, and the
/// definitions they use, each as a new quantity.
GiNaC::exmap LieAlgebra::replaced(GiNaC::exmap with, const std::string& tag) {
  std::vector<Slot> wanted = measurements();
  for (const auto& [state, rate] : rates_of(system_)) wanted.push_back(rate);
  return replaced(std::move(with), tag, wanted);
}

GiNaC::exmap LieAlgebra::replaced(GiNaC::exmap with, const std::string& tag,
                                  const std::vector<Slot>& wanted) {
  const std::vector<bool> needed = system_.graph.needed_for(wanted);
  for (Slot slot = 0; slot < static_cast<Slot>(needed.size()); ++slot) {
    if (!needed[static_cast<std::size_t>(slot)] || !system_.graph[slot].expression) continue;
    const ex before = *system_.graph[slot].expression,
             after = before.subs(with, GiNaC::subs_options::no_pattern);
    if (after.is_equal(before)) continue;
    with[system_.graph[slot].symbol] = is_atomic(after) ? after : quantity_like(slot, after, tag);
  }
  return with;
}

/// Symbol of a new quantity that replaces a given one.
ex LieAlgebra::quantity_like(Slot original, const ex& expression, const std::string& tag) {
  const std::string name = system_.graph[original].name + tag;
  const Owner owner = system_.graph[original].owner;
  const SourceLocation location = system_.graph[original].location;
  return system_.graph[system_.graph.define(name, owner, expression, location)].symbol;
}

/// Substitutes the expressions of tied inputs in all rates and measurements.
void LieAlgebra::substitute(const std::vector<SymbolicSystem::Assignment>& tied) {
  if (tied.empty()) return;
  GiNaC::exmap with;
  for (const auto& a : tied) {
    std::vector<Slot> parts;
    for (const auto& [part, partial] : system_.graph[a.value].partials) parts.push_back(part);
    const ex value =
        system_.graph[a.value].expression->subs(replaced(with, "", parts), GiNaC::subs_options::no_pattern);
    const ex symbol = system_.graph[a.target].symbol;
    with[symbol] = is_atomic(value) ? value : quantity_like(a.target, value, "");
  }
  with = replaced(with, "");
  for (auto* block : {&system_.vehicle, &system_.landmark, &system_.anchor})
    for (auto* quantities : {&block->rates, &block->measurements})
      for (Slot& slot : *quantities) slot = substituted(slot, with);
}

/// The quantity of the same name with tied inputs substituted.
LieAlgebra::Slot LieAlgebra::substituted(Slot original, const GiNaC::exmap& with) {
  const auto found = with.find(system_.graph[original].symbol);
  if (found == with.end()) return original;
  const auto slot_of = [&](const ex& e) { return system_.graph.slot_of(GiNaC::ex_to<GiNaC::symbol>(e)); };
  const bool own = GiNaC::is_a<GiNaC::symbol>(found->second) &&
                   system_.graph[slot_of(found->second)].name == system_.graph[original].name;
  return slot_of(own ? found->second : quantity_like(original, found->second, ""));
}

VectorField LieAlgebra::field(const std::string& name, const GiNaC::exmap& with) const {
  VectorField field{name, {}};
  for (const auto& [state, rate] : rates_of(system_)) {
    const ex value = system_.graph[rate].expression->subs(with, GiNaC::subs_options::no_pattern);
    if (!value.is_zero()) field.rates[state] = value;
  }
  return field;
}

/// One field per input, if rates are linear in the inputs: the derivatives of the rates, with the other inputs at 0.
void LieAlgebra::add_input_fields(const std::vector<Slot>& inputs, const GiNaC::exmap& others_zero) {
  for (const Slot input : inputs) {
    VectorField along{system_.graph[input].name, {}};
    for (const auto& [state, rate] : rates_of(system_)) {
      const ex part = system_.graph.derivative(*system_.graph[rate].expression, input).subs(others_zero);
      if (!part.is_zero()) along.rates[state] = part;
    }
    if (!along.rates.empty()) fields_.push_back(along);
  }
}

bool LieAlgebra::measures(const std::vector<Slot>& inputs) const {
  for (const Slot measurement : measurements())
    for (const Slot input : inputs)
      if (!system_.graph.derivative(system_.graph[measurement].symbol, input).is_zero()) return true;
  return false;
}

void LieAlgebra::add_fields(int other_inputs) {
  MotionInputs inputs = motion_inputs(system_);
  substitute(inputs.tied);
  std::vector<Slot> all = inputs.held;
  all.insert(all.end(), inputs.free.begin(), inputs.free.end());
  const bool affine_in_draws =
      system_.draws.empty() || (inputs_affine_in_draws(system_) && is_linear_in(all));
  nonlinear_ = inputs.mixed || !affine_in_draws || !is_linear_in(inputs.free);
  if (nonlinear_) {
    inputs.held = all;
    inputs.free.clear();
  }
  GiNaC::exmap at_rest = inputs.zero;
  for (const Slot input : inputs.free) at_rest[system_.graph[input].symbol] = 0;
  const GiNaC::exmap drift = replaced(at_rest, "(0)");
  const VectorField zero_field = field("0", drift);
  if (!zero_field.rates.empty()) fields_.push_back(zero_field);
  add_input_fields(inputs.free, drift);
  // Inputs held at only one set of values yield one field
  const int sets = !moves_with(inputs.held) ? 0
                   : nonlinear_             ? other_inputs
                                : std::min<int>(other_inputs, static_cast<int>(system_.draws.size()));
  if (measures(all))
    add_further_sets(other_inputs, all, inputs.zero, sets > 0);
  else
    add_further_sets(sets, inputs.held, inputs.zero, true);
}

/// `as_fields`: whether rates with these inputs become fields; measurements with them are added in any case.
void LieAlgebra::add_further_sets(int count, const std::vector<Slot>& held, const GiNaC::exmap& zero,
                                  bool as_fields) {
  for (int set = 0; set < count; ++set) {
    const std::string tag = "(" + std::to_string(set + 2) + ")";
    std::vector<Slot> copies(system_.inputs.size(), -1);
    GiNaC::exmap to_copies = zero;
    for (std::size_t i = 0; i < system_.inputs.size(); ++i) {
      const Slot input = system_.inputs[i];
      if (std::find(held.begin(), held.end(), input) == held.end()) continue;
      copies[i] = system_.graph.add_atom(system_.graph[input].name + tag, Owner::vehicle, {});
      to_copies[system_.graph[input].symbol] = system_.graph[copies[i]].symbol;
    }
    copies_.push_back(copies);
    const GiNaC::exmap all = replaced(to_copies, tag);
    if (as_fields) fields_.push_back(field("0" + tag, all));
    for (const Slot measurement : measurements()) {
      const auto other = all.find(system_.graph[measurement].symbol);
      if (other != all.end() && GiNaC::is_a<GiNaC::symbol>(other->second))
        other_measurements_.push_back(
            {measurement, system_.graph.slot_of(GiNaC::ex_to<GiNaC::symbol>(other->second))});
    }
  }
}

ex LieAlgebra::derived(Slot quantity, int field, SourceLocation location) {
  const auto key = std::make_pair(quantity, field);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  const VectorField& along = fields_[static_cast<std::size_t>(field)];
  ex total = 0;
  if (!system_.graph[quantity].expression) {
    const auto rate = along.rates.find(quantity);
    if (rate != along.rates.end()) total = rate->second;
  } else {
    // By index, since quantities are added during the loop
    for (std::size_t i = 0; i < system_.graph[quantity].partials.size(); ++i) {
      const auto [inner, partial] = system_.graph[quantity].partials[i];
      total += partial * derived(inner, field, location);
    }
  }
  if (!is_atomic(total)) {
    const Owner owner = system_.graph[quantity].owner;
    const std::string name = "L_" + along.name + " " + system_.graph[quantity].name;
    total = system_.graph[system_.graph.define(name, owner, total, location)].symbol;
  }
  known_.emplace(key, total);
  return total;
}

Slot LieAlgebra::derive(Slot quantity, int field, SourceLocation location) {
  const ex result = derived(quantity, field, location);
  return GiNaC::is_a<GiNaC::symbol>(result) ? system_.graph.slot_of(GiNaC::ex_to<GiNaC::symbol>(result)) : -1;
}

}  // namespace incognita
