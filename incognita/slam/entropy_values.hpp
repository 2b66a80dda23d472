// Entropies in nats.
#pragma once

#include <limits>

namespace incognita {

/// From log-determinants: thesis (6.2). Map and total are refreshed about once a second.
struct Entropy {
  double vehicle = std::numeric_limits<double>::quiet_NaN();
  double map = std::numeric_limits<double>::quiet_NaN();
  double total = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace incognita
