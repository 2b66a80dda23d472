// When a difference of large numbers says nothing any more.
#pragma once

#include <limits>

namespace incognita {

/// What `terms` subtractions left of a positive number tells nothing but how they were rounded.
inline bool is_rounding(double left, double of, int terms) {
  constexpr int own = 4;  // roundings of each term itself: a quotient, a root, a square
  return !(left > (terms + own) * std::numeric_limits<double>::epsilon() * of);
}

}  // namespace incognita
