// Validation of steering laws before the first command.
#pragma once

#include "incognita/control/steering.hpp"

namespace incognita {

/// Throws UnfitSetting if that law cannot steer that motion along that path with commands held for `period_s`, and
/// std::invalid_argument as check(Path). Checks of the laws' own constructors are not repeated.
void check_steering(const AnyMotion& motion, const SteeringSettings& settings, double period_s);

}  // namespace incognita
