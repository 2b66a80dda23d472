// Classification of a system's inputs by how the kind of motion sets them.
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {

struct MotionInputs {
  using Slot = SymbolicSystem::Slot;

  std::vector<Slot> free;  ///< arbitrary over time
  std::vector<Slot> held;  ///< set from states, draws or numbers: known and constant within a segment
  GiNaC::exmap zero;       ///< symbol of an input -> 0
  /// Set from free inputs, and from held ones and parameters (`u1 = "u2"`), in evaluation order. They vary
  /// with the free ones, so their expressions must be substituted before differentiation.
  std::vector<SymbolicSystem::Assignment> tied;
  /// Some held inputs depend on free inputs together with states or draws (`u1 = "q*u2"`): they vary with the
  /// free ones, and only drawn sets of all inputs represent them.
  bool mixed = false;
};

MotionInputs motion_inputs(const SymbolicSystem& system);

/// Whether every assigned input is an affine function of the motion's draws, as far as this is visible
/// without rewriting.
bool inputs_affine_in_draws(const SymbolicSystem& system);

}  // namespace incognita
