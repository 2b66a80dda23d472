// The true motion of a vehicle: its continuous equations, integrated adaptively.
#pragma once

#include <cstdint>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/models/any_motion.hpp"

namespace incognita {

struct PlantSettings {
  SmallVector start;         ///< state at t = 0
  SmallVector start_sigmas;  ///< the true start is drawn around it; one per error, 0 for none
  SmallVector input_sigmas;  ///< of what disturbs each input, drawn anew for each tick and held over it
  SmallVector least_input;   ///< what the body can do: asked for more, it does this
  SmallVector most_input;
  SmallVector input_ratios =
      {};  ///< true input over the one carried out, as with wheels of another size; none: 1
};

class Plant {
 public:
  /// `name`: of its random streams. Throws std::invalid_argument where a size does not fit the motion or a
  /// number cannot be.
  Plant(AnyMotion motion, const PlantSettings& settings, std::uint64_t seed, const std::string& name);

  const AnyMotion& motion() const { return motion_; }
  const SmallVector& state() const { return state_; }
  /// The input of the last tick as it was carried out, within the limits and before it was disturbed: what
  /// odometry tells.
  const SmallVector& executed() const { return executed_; }
  /// The same as it really was: of wheels of their true size, and disturbed.
  const SmallVector& in_force() const { return in_force_; }

  /// d(state)/dt as it moved last, with what disturbed it.
  SmallVector rate() const { return rate_of(motion_, state_, in_force_); }

  /// The state after the input was held for `dt_s` seconds (Dormand-Prince, Odeint, to 1e-10). Throws
  /// std::invalid_argument where input or time are not finite or the time is negative.
  const SmallVector& move(const SmallVector& input, double dt_s);

  /// Puts the body elsewhere, as an obstacle does that it met. Throws std::invalid_argument likewise.
  void put(const SmallVector& state);

 private:
  AnyMotion motion_;
  PlantSettings settings_;
  RandomStream disturbance_;
  SmallVector state_, executed_, in_force_;
};

}  // namespace incognita
