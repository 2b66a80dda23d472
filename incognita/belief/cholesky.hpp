// Cholesky's factor at the speed of rank_update.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/rank_update.hpp"

namespace incognita {

/// Columns that are factorised at a time, by Eigen; up to as many all are.
inline constexpr int cholesky_block = 64;

/// Numbers that cholesky() needs to work in.
constexpr std::size_t cholesky_workspace(int n) {
  return static_cast<std::size_t>(round_up_to_panel(n) + cholesky_block) * cholesky_block;
}

/// Lower triangle of S <- L, S = L L'. S is n x n, column-major, 64-byte aligned, with a leading dimension
/// `stride` that is a multiple of 8 and at least round_up_to_panel(n), and what is above the diagonal or
/// below row n is scratch. False when S is not positive definite; it is spoilt then. `workspace` is 64-byte
/// aligned.
bool cholesky(double* S, int stride, int n, double* workspace);

/// log|S|, by its lower triangle; not a number where S is not positive definite. Allocates.
double log_determinant(const Eigen::MatrixXd& S);

}  // namespace incognita
