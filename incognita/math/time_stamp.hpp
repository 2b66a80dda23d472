// Time stamps of data sets.
#pragma once

#include <optional>
#include <string_view>

namespace incognita {

/// Seconds of a time stamp in whole nanoseconds. Zero decimals and exponents are accepted, because tables exported
/// from floating-point columns contain them (`1403636579763555584.0`, `1.4036365797635556e+18`). Returns nothing for
/// nonzero decimals, which mean a stamp in seconds, and for text that is not a finite number.
std::optional<double> seconds_from_nanoseconds(std::string_view text);

}  // namespace incognita
