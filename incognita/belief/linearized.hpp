// The interface between models and filter: linearized motions and measurements, whatever model and
// linearization made them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "incognita/math/small_matrix.hpp"

namespace incognita {

/// Identifies a block of the state; never reused after the block is dropped.
using BlockId = std::uint32_t;

inline constexpr int max_block_size = max_small;  ///< maximum errors of one block
inline constexpr int max_measurement_rows = 6;    ///< maximum rows of one measurement
inline constexpr int max_measurement_blocks = 3;  ///< maximum blocks one measurement depends on

/// Small stack-allocated matrices: no heap allocation in the loop.
using BlockVector = SmallVector;
using BlockMatrix = SmallMatrix;
using MeasurementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_measurement_rows, 1>;
using MeasurementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_measurement_rows, max_measurement_rows>;
using MeasurementJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_measurement_rows, max_block_size>;

/// Linearized motion of one block: error after = A * error before + noise of covariance N (A.2.4).
struct LinearizedMotion {
  BlockId block = 0;
  BlockVector x_next;  ///< mean afterwards, as stored (chart.ambient() numbers)
  BlockMatrix A;       ///< errors x errors
  BlockMatrix N;       ///< errors x errors, positive semidefinite
};

/// Linearized measurement: residual = sum of H_i * error of block i + noise of covariance R (A.2.6).
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

/// Dependence of a new block's error on that of an existing block.
struct BlockParent {
  BlockId block = 0;
  BlockMatrix J;  ///< errors of the new block x errors of the parent
};

}  // namespace incognita
