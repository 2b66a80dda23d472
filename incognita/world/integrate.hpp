// Integration of continuous motion models with error control.
#pragma once

#include "incognita/models/any_motion.hpp"

namespace incognita {

/// State after holding the input for `dt_s` > 0 seconds (Dormand-Prince, Odeint, tolerance 1e-10 m and rad).
/// Angles are wrapped and quaternions normalized.
SmallVector integrate(const AnyMotion& motion, const SmallVector& state, const SmallVector& input,
                      double dt_s);

}  // namespace incognita
