// Blocked Cholesky factorization on top of rank_update.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/rank_update.hpp"

namespace incognita {

/// Columns factorized at a time by Eigen; smaller matrices are factorized by Eigen alone.
inline constexpr int cholesky_block = 64;

/// Size of the workspace of cholesky(), in doubles.
constexpr std::size_t cholesky_workspace(int n) {
  return static_cast<std::size_t>(round_up_to_panel(n) + cholesky_block) * cholesky_block;
}

/// Overwrites the lower triangle of S with L, S = L L'. S is n x n, column-major, 64-byte aligned, with a
/// leading dimension `stride` that is a multiple of 8 and at least round_up_to_panel(n). The upper triangle
/// and the rows below n are scratch. Returns false when S is not positive definite; its content is undefined
/// then. `workspace` is 64-byte aligned.
bool cholesky(double* S, int stride, int n, double* workspace);

/// log|S| from the lower triangle; NaN when S is not positive definite. Allocates.
double log_determinant(const Eigen::MatrixXd& S);

}  // namespace incognita
