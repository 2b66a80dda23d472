// Vectors of dynamic size, and their operations through a chart.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "incognita/math/chart.hpp"
#include "incognita/math/small_matrix.hpp"

namespace incognita::testing {

inline SmallVector vec(std::initializer_list<double> numbers) {
  SmallVector v(static_cast<Eigen::Index>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), v.begin());
  return v;
}

/// x (+) e
inline SmallVector plus(const Chart& chart, SmallVector x, const SmallVector& e) {
  chart.plus({x.data(), static_cast<std::size_t>(x.size())}, {e.data(), static_cast<std::size_t>(e.size())});
  return x;
}

/// y (-) x
inline SmallVector minus(const Chart& chart, const SmallVector& y, const SmallVector& x) {
  SmallVector e(chart.tangent());
  chart.minus({y.data(), static_cast<std::size_t>(y.size())}, {x.data(), static_cast<std::size_t>(x.size())},
              {e.data(), static_cast<std::size_t>(e.size())});
  return e;
}

}  // namespace incognita::testing
