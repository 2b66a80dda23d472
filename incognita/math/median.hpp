// The median of numbers whose order does not matter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace incognita {

/// The upper one of an even number of values. Reorders them; they must not be none.
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace incognita
