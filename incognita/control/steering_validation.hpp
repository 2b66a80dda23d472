// Which laws of steering can not be, told before the first command.
#pragma once

#include <string>

#include "incognita/control/steering.hpp"

namespace incognita {

/// Why that law cannot steer that motion along that path with commands held for `period_s`; empty when it
/// can. What a law's own constructor refuses is left to it.
std::string validate_steering(const AnyMotion& motion, const SteeringSettings& settings, double period_s);

}  // namespace incognita
