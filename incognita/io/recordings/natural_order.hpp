// The order of numbered file names: img2 before img10.
#pragma once

#include <string>

namespace incognita {

/// Digit sequences of any length compare as numbers.
bool naturally_before(const std::string& a, const std::string& b);

}  // namespace incognita
