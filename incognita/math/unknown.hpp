// A number that is not known, in tables and files.
#pragma once

#include <limits>

namespace incognita {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace incognita
