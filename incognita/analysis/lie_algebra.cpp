#include "incognita/analysis/lie_algebra.hpp"

#include <algorithm>

namespace incognita {
namespace {

using GiNaC::ex;
using Slot = ExpressionGraph::Slot;

/// Rates by state, of vehicle and landmark.
std::map<Slot, Slot> rates_of(const SymbolicSystem& system) {
  std::map<Slot, Slot> rates;
  for (const auto* block : {&system.vehicle, &system.landmark})
    for (std::size_t i = 0; i < block->rates.size(); ++i) rates[block->states[i]] = block->rates[i];
  return rates;
}

/// What the kind of motion makes of an input: nothing, zero always, or tied to the state or to a number.
enum class Input { free, zero, held };

Input kind_of(const SymbolicSystem& system, std::size_t which) {
  for (const auto& a : system.assignments) {
    if (!a.to_input || a.target != system.inputs[which]) continue;
    return system.graph[a.value].expression->is_zero() ? Input::zero : Input::held;
  }
  const NamedRange& range = system.input_ranges[which];
  if (range.low < range.high) return Input::free;
  return range.low == 0 ? Input::zero : Input::held;
}

}  // namespace

LieAlgebra::LieAlgebra(const SymbolicSystem& system, int other_inputs) : system_(system) {
  add_fields(other_inputs);
}

LieAlgebra::Inputs LieAlgebra::sorted_inputs() const {
  Inputs inputs;
  for (std::size_t i = 0; i < system_.inputs.size(); ++i) {
    const Slot input = system_.inputs[i];
    const Input kind = kind_of(system_, i);
    if (kind == Input::zero) inputs.zero[system_.graph[input].symbol] = 0;
    if (kind == Input::free) inputs.free.push_back(input);
    if (kind == Input::held) inputs.held.push_back(input);
  }
  return inputs;
}

/// As far as that shows without rewriting: a second derivative that is not 0 on sight counts as one.
bool LieAlgebra::is_linear_in(const std::vector<Slot>& inputs) const {
  for (const auto& [state, rate] : rates_of(system_))
    for (const Slot a : inputs) {
      const ex first = system_.graph.derivative(*system_.graph[rate].expression, a);
      for (const Slot b : inputs)
        if (!system_.graph.derivative(first, b).is_zero()) return false;
    }
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

/// From what stands for inputs to what stands for every quantity that they are in: rates and measurements,
/// and the definitions those are made of, each a quantity of its own.
GiNaC::exmap LieAlgebra::replaced(GiNaC::exmap with, const std::string& tag) {
  std::vector<Slot> wanted = measurements();
  for (const auto& [state, rate] : rates_of(system_)) wanted.push_back(rate);
  const std::vector<bool> needed = system_.graph.needed_for(wanted);
  for (Slot slot = 0; slot < static_cast<Slot>(needed.size()); ++slot) {
    if (!needed[static_cast<std::size_t>(slot)] || !system_.graph[slot].expression) continue;
    const ex before = *system_.graph[slot].expression,
             after = before.subs(with, GiNaC::subs_options::no_pattern);
    if (after.is_equal(before)) continue;
    const ex symbol = system_.graph[slot].symbol;
    const bool simple = GiNaC::is_a<GiNaC::numeric>(after) || GiNaC::is_a<GiNaC::symbol>(after);
    with[symbol] = after;
    if (simple) continue;
    const std::string name = system_.graph[slot].name + tag;
    const Owner owner = system_.graph[slot].owner;
    const Place place = system_.graph[slot].place;
    with[symbol] = system_.graph[system_.graph.define(name, owner, after, place)].symbol;
  }
  return with;
}

VectorField LieAlgebra::field(const std::string& name, const GiNaC::exmap& with) const {
  VectorField field{name, {}};
  for (const auto& [state, rate] : rates_of(system_)) {
    const ex value = system_.graph[rate].expression->subs(with, GiNaC::subs_options::no_pattern);
    if (!value.is_zero()) field.rates[state] = value;
  }
  return field;
}

/// One for each input, of rates that are linear in them: the rates' derivatives, where the others are 0.
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
  Inputs inputs = sorted_inputs();
  std::vector<Slot> all = inputs.held;
  all.insert(all.end(), inputs.free.begin(), inputs.free.end());
  nonlinear_ = !is_linear_in(inputs.free);
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
  // Inputs that are held in one way only make one field
  const int sets = !moves_with(inputs.held) ? 0
                   : nonlinear_             ? other_inputs
                                : std::min<int>(other_inputs, static_cast<int>(system_.draws.size()));
  if (measures(all))
    add_further_sets(other_inputs, all, inputs.zero, sets > 0);
  else
    add_further_sets(sets, inputs.held, inputs.zero, true);
}

/// `as_fields`: rates with those inputs are fields; measurements with them are other measurements in any
/// case.
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

ex LieAlgebra::derived(Slot quantity, int field, Place place) {
  const auto key = std::make_pair(quantity, field);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  const VectorField& along = fields_[static_cast<std::size_t>(field)];
  ex total = 0;
  if (!system_.graph[quantity].expression) {
    const auto rate = along.rates.find(quantity);
    if (rate != along.rates.end()) total = rate->second;
  } else {
    // By index: quantities are added while this one is looked at
    for (std::size_t i = 0; i < system_.graph[quantity].partials.size(); ++i) {
      const auto [inner, partial] = system_.graph[quantity].partials[i];
      total += partial * derived(inner, field, place);
    }
  }
  const bool simple = GiNaC::is_a<GiNaC::numeric>(total) || GiNaC::is_a<GiNaC::symbol>(total);
  if (!simple) {
    const Owner owner = system_.graph[quantity].owner;
    const std::string name = "L_" + along.name + " " + system_.graph[quantity].name;
    total = system_.graph[system_.graph.define(name, owner, total, place)].symbol;
  }
  known_.emplace(key, total);
  return total;
}

Slot LieAlgebra::derive(Slot quantity, int field, Place place) {
  const ex result = derived(quantity, field, place);
  return GiNaC::is_a<GiNaC::symbol>(result) ? system_.graph.slot_of(GiNaC::ex_to<GiNaC::symbol>(result)) : -1;
}

}  // namespace incognita
