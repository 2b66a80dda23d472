// Symmetric matrix with accumulated rows: M <- M + rows' rows. What concerns few rows and columns is done in place: the matrix
// is as large as the map.
#pragma once

#include <Eigen/Core>

#include "incognita/belief/aligned_buffer.hpp"

namespace incognita {

class StateArchive;

/// Uses the filter's rank update, which is several times faster than Eigen's on processors with wide
/// registers. That one subtracts, so the negative of M is stored.
class RowSum {
 public:
  int size() const { return size_; }
  /// Adds `by` rows and columns of zeros.
  void grow(int by);
  /// `rows`: any number x size().
  void add(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// M <- M - rows' rows. `rows`: any number x size(); fast for few.
  void subtract(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Rows of M from `first` on: count x size().
  Eigen::MatrixXd rows(int first, int count) const;
  /// Replaces the rows from `first` on and the same columns; `rows`: any number x size(), symmetric in its own columns.
  void set_rows(int first, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Removes rows and the same columns.
  void remove(int first, int count);
  /// Both triangles.
  Eigen::MatrixXd matrix() const;

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  using Lower = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Lower lower() { return {minus_.data(), size_, size_, Eigen::OuterStride<>(stride_)}; }
  Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> lower() const {
    return {minus_.data(), size_, size_, Eigen::OuterStride<>(stride_)};
  }
  void reserve(int size);

  int size_ = 0;
  int capacity_ = 0;
  int stride_ = 0;
  AlignedBuffer minus_;   ///< the lower triangle
  AlignedBuffer packed_;  ///< rows in the panels of rank_update
};

}  // namespace incognita
