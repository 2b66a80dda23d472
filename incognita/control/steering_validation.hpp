// Validation of steering laws before the first command.
#pragma once

#include <string>

#include "incognita/control/steering.hpp"

namespace incognita {

/// Reason why that law cannot steer that motion along that path with commands held for `period_s`; empty if
/// it can. Checks of the laws' own constructors are not repeated.
std::string validate_steering(const AnyMotion& motion, const SteeringSettings& settings, double period_s);

}  // namespace incognita
