// Steering law of one vehicle: from its estimated state and its path to its next input.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "incognita/control/paths/reference_path.hpp"
#include "incognita/control/settings.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_motion.hpp"

namespace incognita {

struct SteeringSettings : LawSettings {
  ControlLaw law = ControlLaw::none;
  Path path;                    ///< in time since the first tick
  SmallVector input = {};       ///< `none`: constant input of the motion model
  ControlSettings camera = {};  ///< bodies in space: gains of (5.29), and limits besides most_input
  SmallVector most_input = {};  ///< limits of the inputs, both signs
};

/// The law itself; for `active` the usual law of the motion.
ControlLaw law_of(const AnyMotion& motion, ControlLaw law);

/// Steering law of one vehicle.
class Steering {
 public:
  virtual ~Steering() = default;
  /// Input until the next tick; `t`: s since the first tick.
  virtual SmallVector act(const SmallVector& estimate, double t) const = 0;
};

/// `period_s`: duration of one command. Throws std::invalid_argument, with the reason, if the law cannot steer that
/// motion along that path: gains that do not converge with held commands, a control point on the axle, a path too
/// fast or too tight for the vehicle, wrong sizes, invalid numbers; UnfitSetting where settings of a scenario are the
/// cause. No command exceeds `most_input`.
std::unique_ptr<Steering> make_steering(const AnyMotion& motion, const SteeringSettings& settings,
                                        double period_s);

}  // namespace incognita
