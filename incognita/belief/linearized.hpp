// The narrow waist: what a motion or a look is to the filter, whichever model and lineariser made it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "incognita/math/small_matrix.hpp"

namespace incognita {

/// Names a block of the state for as long as the block lives; never used again.
using BlockId = std::uint32_t;

inline constexpr int max_block_size = max_small;  ///< errors of one block
inline constexpr int max_measurement_rows = 6;    ///< numbers of one measurement
inline constexpr int max_measurement_blocks = 3;  ///< blocks one measurement depends on

/// Small matrices that live on the stack: no allocation in the loop.
using BlockVector = SmallVector;
using BlockMatrix = SmallMatrix;
using MeasurementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_measurement_rows, 1>;
using MeasurementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_measurement_rows, max_measurement_rows>;
using MeasurementJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_measurement_rows, max_block_size>;

/// One block moves: error after = A * error before + noise of covariance N (A.2.4).
struct LinearizedMotion {
  BlockId block = 0;
  BlockVector x_next;  ///< mean after, as stored (chart.ambient() numbers)
  BlockMatrix A;       ///< errors x errors
  BlockMatrix N;       ///< errors x errors, positive semi-definite
};

/// One measurement: residual = sum of H_i * error of block i + noise of covariance R (A.2.6).
struct LinearizedMeasurement {
  struct Part {
    BlockId block = 0;
    MeasurementJacobian H;  ///< rows x errors of the block
  };
  std::array<Part, max_measurement_blocks> parts;
  int part_count = 0;
  MeasurementVector residual;  ///< measured (-) predicted, in the chart of the measurement
  MeasurementMatrix R;         ///< rows x rows, positive definite

  int rows() const { return static_cast<int>(residual.size()); }
  template <class Derived>
  void add(BlockId block, const Eigen::MatrixBase<Derived>& H) {
    if (part_count == max_measurement_blocks)
      throw std::length_error("a measurement depends on 3 blocks at most");
    parts[part_count].block = block;
    parts[part_count++].H = H;
  }
};

/// What the error of a block is born from: J times the error of another.
struct BlockParent {
  BlockId block = 0;
  BlockMatrix J;  ///< errors of the new block x errors of the parent
};

}  // namespace incognita
