#include "incognita/analysis/lie_algebra.hpp"

#include <algorithm>

namespace incognita {
namespace {

using GiNaC::ex;
using Slot = ExpressionGraph::Slot;

bool depends_on(const ex& e, const std::vector<ex>& symbols) {
  return std::any_of(symbols.begin(), symbols.end(), [&](const ex& s) { return e.has(s); });
}

/// Rates by state, of vehicle and landmark.
std::map<Slot, ex> rates_of(const SymbolicSystem& system) {
  std::map<Slot, ex> rates;
  for (const auto* block : {&system.vehicle, &system.landmark})
    for (std::size_t i = 0; i < block->rates.size(); ++i)
      rates[block->states[i]] = *system.graph[block->rates[i]].expression;
  return rates;
}

/// What the kind of motion makes of an input: nothing, zero always, or tied to the state or to a number.
enum class Input { free, zero, held };

Input kind_of(const SymbolicSystem& system, Slot input) {
  for (const auto& a : system.assignments) {
    if (!a.to_input || a.target != input) continue;
    return system.graph[a.value].expression->is_zero() ? Input::zero : Input::held;
  }
  return Input::free;
}

bool is_linear_in(const std::map<Slot, ex>& rates, const std::vector<ex>& inputs) {
  for (const auto& [state, rate] : rates)
    for (const ex& a : inputs)
      for (const ex& b : inputs) {
        const ex second = rate.diff(GiNaC::ex_to<GiNaC::symbol>(a)).diff(GiNaC::ex_to<GiNaC::symbol>(b));
        if (!second.expand().is_zero()) return false;
      }
  return true;
}

VectorField substituted(const std::string& name, const std::map<Slot, ex>& rates, const GiNaC::exmap& with) {
  VectorField field{name, {}};
  for (const auto& [state, rate] : rates) {
    const ex value = rate.subs(with, GiNaC::subs_options::no_pattern);
    if (!value.is_zero()) field.rates[state] = value;
  }
  return field;
}

}  // namespace

LieAlgebra::LieAlgebra(const SymbolicSystem& system, int other_inputs) : system_(system) {
  add_fields(other_inputs);
}

/// Definitions that the inputs are in are written out, so that what is left of an input shows.
ex LieAlgebra::inlined(const ex& rate) const {
  std::vector<ex> symbols;
  for (const Slot input : system_.inputs) symbols.push_back(system_.graph[input].symbol);
  ex result = rate;
  for (Slot slot = system_.graph.size() - 1; slot >= 0; --slot) {
    const auto& q = system_.graph[slot];
    if (!q.expression || !result.has(q.symbol)) continue;
    if (depends_on(inlined(*q.expression), symbols))
      result = result.subs(q.symbol == *q.expression, GiNaC::subs_options::no_pattern);
  }
  return result;
}

void LieAlgebra::add_fields(int other_inputs) {
  std::map<Slot, ex> rates = rates_of(system_);
  for (auto& [state, rate] : rates) rate = inlined(rate);
  std::vector<Slot> free, held;
  GiNaC::exmap zero;
  for (const Slot input : system_.inputs) {
    const Input kind = kind_of(system_, input);
    if (kind == Input::zero) zero[system_.graph[input].symbol] = 0;
    if (kind == Input::free) free.push_back(input);
    if (kind == Input::held) held.push_back(input);
  }
  rates = substituted("", rates, zero).rates;
  std::vector<ex> free_symbols;
  for (const Slot input : free) free_symbols.push_back(system_.graph[input].symbol);
  nonlinear_ = !is_linear_in(rates, free_symbols);
  if (nonlinear_) held.insert(held.end(), free.begin(), free.end());
  GiNaC::exmap none;
  if (!nonlinear_)
    for (const ex& symbol : free_symbols) none[symbol] = 0;
  const VectorField drift = substituted("0", rates, none);
  if (!drift.rates.empty()) fields_.push_back(drift);
  for (std::size_t i = 0; i < free.size() && !nonlinear_; ++i) {
    VectorField field{system_.graph[free[i]].name, {}};
    for (const auto& [state, rate] : rates) {
      const ex part = rate.diff(GiNaC::ex_to<GiNaC::symbol>(free_symbols[i])).subs(none);
      if (!part.is_zero()) field.rates[state] = part;
    }
    if (!field.rates.empty()) fields_.push_back(field);
  }
  const bool moves = std::any_of(held.begin(), held.end(), [&](Slot input) {
    return std::any_of(drift.rates.begin(), drift.rates.end(),
                       [&](const auto& rate) { return rate.second.has(system_.graph[input].symbol); });
  });
  // Inputs that are held in one way only make one field
  const int sets = !moves       ? 0
                   : nonlinear_ ? other_inputs
                                : std::min<int>(other_inputs, int(system_.draws.size()));
  for (int set = 0; set < sets; ++set) {
    std::vector<Slot> copies(system_.inputs.size(), -1);
    GiNaC::exmap to_copies;
    for (const Slot input : held) {
      const auto index =
          std::find(system_.inputs.begin(), system_.inputs.end(), input) - system_.inputs.begin();
      const auto name = system_.graph[input].name + "(" + std::to_string(set + 2) + ")";
      copies[static_cast<std::size_t>(index)] = system_.graph.add_atom(name, Owner::vehicle, {});
      to_copies[system_.graph[input].symbol] = system_.graph[copies[static_cast<std::size_t>(index)]].symbol;
    }
    copies_.push_back(copies);
    fields_.push_back(substituted("0(" + std::to_string(set + 2) + ")", drift.rates, to_copies));
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
