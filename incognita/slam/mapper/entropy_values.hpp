// Entropies in nats.
#pragma once

#include <algorithm>
#include <cmath>

#include <limits>

namespace incognita {

/// From log-determinants: thesis (6.2). Map and total are refreshed about once a second.
struct Entropy {
  double vehicle = std::numeric_limits<double>::quiet_NaN();
  double map = std::numeric_limits<double>::quiet_NaN();
  double total = std::numeric_limits<double>::quiet_NaN();
};

/// How often map and whole are worked out, which costs the cube of the state: once a second, and the larger
/// the rarer, so that it never costs more than a small share of a run.
inline double entropy_period_s(int states) { return std::max(1.0, std::pow(states / 600.0, 3)); }

}  // namespace incognita
