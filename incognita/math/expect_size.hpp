// Size check of matrix arguments.
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

namespace incognita {

/// Throws std::invalid_argument with both sizes, e.g. "F is 2x3, not 2x2".
inline void expect_size(const char* name, const Eigen::MatrixXd& M, Eigen::Index rows, Eigen::Index columns) {
  if (M.rows() == rows && M.cols() == columns) return;
  const auto size = [](Eigen::Index r, Eigen::Index c) {
    return std::to_string(r) + "x" + std::to_string(c);
  };
  throw std::invalid_argument(std::string(name) + " is " + size(M.rows(), M.cols()) + ", not " +
                              size(rows, columns));
}

}  // namespace incognita
