// Entropies in nats.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {

/// Entropies from log-determinants: thesis (6.2). Map and total are refreshed once a second or, of a large state, less
/// often, that of the bodies at each tick.
struct Entropy {
  double vehicle = std::numeric_limits<double>::quiet_NaN();
  double map = std::numeric_limits<double>::quiet_NaN();
  double total = std::numeric_limits<double>::quiet_NaN();
};

/// Period of an entropy whose cost is cubic in the state and that is computed at once: one second, longer for large
/// states, so that the cost stays a small share of the run time.
inline double entropy_period_s(int states) { return std::max(1.0, std::pow(states / 600.0, 3)); }

}  // namespace incognita
