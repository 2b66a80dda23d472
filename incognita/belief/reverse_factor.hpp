// Cholesky factor of an information matrix in reversed order, from the last error to the first.
//
// Vehicles come first in the state and their covariances are needed at every tick. In this order they depend
// only on the last rows of the factor, at a cost that does not grow with the map.
#pragma once

#include <Eigen/Core>
#include <map>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/triangle.hpp"

namespace incognita {

class ReverseFactor {
 public:
  /// Loads the lower triangle of a matrix; add() may add to it before factorize().
  void load(const Triangle& matrix, int size);
  void add(int row, int column, double value) { L_.column(size_ - 1 - row)[size_ - 1 - column] += value; }
  /// Returns false when the matrix is not positive definite within rounding.
  bool factorize();

  double log_det() const;
  /// Log-determinant of the leading `first` x `first` block of the inverse.
  double log_det_of_inverse(int first) const;
  /// b <- inverse * b.
  void solve(Eigen::Ref<Eigen::VectorXd> b);
  /// A block of the inverse. The required columns of L^-1 are computed on first access and cached.
  Eigen::MatrixXd inverse(int row, int rows, int column, int columns) const;

 private:
  using Factor = const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Factor L() const { return {L_.storage.data(), size_, size_, Eigen::OuterStride<>(L_.stride)}; }
  const Eigen::MatrixXd& half(int first, int count) const;

  int size_ = 0;
  Triangle L_;
  AlignedBuffer workspace_;
  /// Cached columns of L^-1 from their first nonzero row, by first error and number of errors.
  mutable std::map<std::pair<int, int>, Eigen::MatrixXd> halves_;
};

}  // namespace incognita
