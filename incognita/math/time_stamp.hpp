// Time stamps as data sets write them.
#pragma once

#include <optional>
#include <string_view>

namespace incognita {

/// Seconds of a stamp in whole nanoseconds. Decimals that are zeros and exponents, which tables saved from
/// floating-point numbers have, change nothing (`1403636579763555584.0`, `1.4036365797635556e+18`). Nothing
/// for other decimals, which are those of a stamp in seconds, and for what is no finite number.
std::optional<double> seconds_from_nanoseconds(std::string_view text);

}  // namespace incognita
