// Small vectors and matrices of a size known only at run time, stored on the stack.
#pragma once

#include <Eigen/Core>

namespace incognita {

inline constexpr int max_small = 16;

using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_small, 1>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_small, max_small>;

}  // namespace incognita
