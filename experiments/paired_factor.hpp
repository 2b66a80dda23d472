// How much larger a number is one way than another in the same seeds, and what counts as no difference.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/compared_numbers.hpp"
#include "experiments/evidence.hpp"

namespace incognita {

/// Of logarithms, back to numbers.
inline Interval exponential(const Interval& i) {
  return {std::exp(i.value), std::exp(i.low), std::exp(i.high)};
}

/// a / b of each pair, the geometric mean; positive numbers.
inline Interval factor(const std::vector<double>& a, const std::vector<double>& b) {
  return exponential(bootstrap_mean(log_ratios(a, b)));
}

/// The margin within which two ways count as equally good: a factor from 0.8 to 1.25.
inline constexpr double as_good_factor = 1.25;
inline Answer as_good(const Interval& factor) {
  return is_above(factor, 1 / as_good_factor) && is_below(factor, as_good_factor);
}

/// By how much more: a factor of 1.02 is 2 %.
inline Interval in_percent(const Interval& factor) {
  return {100 * (factor.value - 1), 100 * (factor.low - 1), 100 * (factor.high - 1)};
}

/// Rule::boundedness, of what a quantity is at the end over what it was at half of the time.
inline Answer has_stopped_growing(const Interval& factor) { return is_below(factor, 1.05); }

}  // namespace incognita
