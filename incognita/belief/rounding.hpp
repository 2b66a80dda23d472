// Detection of catastrophic cancellation.
#pragma once

#include <limits>

namespace incognita {

/// True when `left`, the result of `terms` subtractions from the positive number `of`, is within rounding of 0.
inline bool is_rounding(double left, double of, int terms) {
  constexpr int own = 4;  // rounding errors in each term itself: a quotient, a root, a square
  return !(left > (terms + own) * std::numeric_limits<double>::epsilon() * of);
}

}  // namespace incognita
