// The rule `boundedness` of the ledger: what grows by less than 5 % from half of the time to its end counts as
// bounded, what grows by more as unbounded.
#pragma once

#include "experiments/evidence.hpp"

namespace incognita {

inline constexpr double bounded_growth = 0.05;

/// Share by which something grows.
inline double growth_between(double at_half, double at_end) { return at_end / at_half - 1; }

inline Answer is_bounded(const Interval& growth) { return is_below(growth, bounded_growth); }
inline Answer is_bounded(double growth) { return growth < bounded_growth; }

}  // namespace incognita
