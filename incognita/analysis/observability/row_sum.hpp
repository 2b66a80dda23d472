// Symmetric matrix with accumulated rows: M <- M + rows' rows.
#pragma once

#include <Eigen/Core>

#include "incognita/belief/aligned_buffer.hpp"

namespace incognita {

/// Uses the filter's rank update, which is several times faster than Eigen's on processors with wide
/// registers. That one subtracts, so the negative of M is stored.
class RowSum {
 public:
  int size() const { return size_; }
  /// Adds `by` rows and columns of zeros.
  void grow(int by);
  /// `rows`: any number x size().
  void add(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Both triangles.
  Eigen::MatrixXd matrix() const;
  /// Replaces the matrix by one of any size.
  void set(const Eigen::MatrixXd& matrix);

 private:
  void reserve(int size);

  int size_ = 0;
  int capacity_ = 0;
  int stride_ = 0;
  AlignedBuffer minus_;   ///< the lower triangle
  AlignedBuffer packed_;  ///< rows in the panels of rank_update
};

}  // namespace incognita
