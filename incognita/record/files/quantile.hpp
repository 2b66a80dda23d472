// Quantiles of what a run measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace incognita {

/// The smallest value that at least this share of the values do not exceed; of one value or more.
inline double quantile(std::vector<double> values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace incognita
