// True motion of a vehicle: its continuous equations, integrated adaptively.
#pragma once

#include <cstdint>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/models/any_motion.hpp"

namespace incognita {

class StateArchive;

struct PlantSettings {
  SmallVector start;         ///< state at t = 0
  SmallVector start_sigmas;  ///< sigmas of the true start, one per error component; 0 for none
  SmallVector input_sigmas;  ///< sigmas of the input disturbances, drawn per tick and held
  SmallVector least_input;   ///< limits of the inputs; commands are clamped
  SmallVector most_input;
  SmallVector input_ratios = {};  ///< true over commanded input, e.g. for a different wheel size; empty: 1
};

class Plant {
 public:
  /// `name`: of its random streams. Throws std::invalid_argument if a size does not fit the motion model or a
  /// number is invalid.
  Plant(AnyMotion motion, const PlantSettings& settings, std::uint64_t seed, const std::string& name);

  const AnyMotion& motion() const { return motion_; }
  const SmallVector& state() const { return state_; }
  /// The clamped input of the last tick, before disturbances: what odometry measures.
  const SmallVector& executed() const { return executed_; }
  /// The true input of the last tick: with input ratios and disturbances.
  const SmallVector& in_force() const { return in_force_; }

  /// State after holding the input for `dt_s` seconds (Dormand-Prince, Odeint, tolerance 1e-10). Throws
  /// std::invalid_argument if the input or the time is not finite or the time is negative.
  const SmallVector& move(const SmallVector& input, double dt_s);

  /// Sets the state, e.g. after a collision with an obstacle. Throws std::invalid_argument for a wrong size
  /// or numbers that are not finite.
  void put(const SmallVector& state);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  AnyMotion motion_;
  PlantSettings settings_;
  RandomStream disturbance_;
  SmallVector state_, executed_, in_force_;
};

}  // namespace incognita
