// Continuous motions, integrated with error control.
#pragma once

#include "incognita/models/any_motion.hpp"

namespace incognita {

/// The state after the input was held for `dt_s` seconds, dt_s > 0 (Dormand-Prince, Odeint, to 1e-10 m and
/// rad). Angles and quaternions are brought back to where they are kept.
SmallVector integrate(const AnyMotion& motion, const SmallVector& state, const SmallVector& input,
                      double dt_s);

}  // namespace incognita
