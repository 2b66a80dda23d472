// Cholesky's factor of an information matrix, its errors taken from the last to the first.
//
// Vehicles come first in a state, and are asked for at every tick: this way what is marginal of them stands
// in the last rows of the factor, and costs nothing that grows with the map.
#pragma once

#include <Eigen/Core>
#include <map>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/triangle.hpp"

namespace incognita {

class ReverseFactor {
 public:
  /// Takes the lower triangle of a matrix; add() may then add to it before factorize().
  void load(const Triangle& matrix, int size);
  void add(int row, int column, double value) { L_.column(size_ - 1 - row)[size_ - 1 - column] += value; }
  /// False when the matrix is not positive definite within rounding.
  bool factorize();

  double log_det() const;
  /// Of the inverse's first rows and columns.
  double log_det_of_inverse(int first) const;
  /// b <- inverse * b.
  void solve(Eigen::Ref<Eigen::VectorXd> b);
  /// Elements of the inverse. What they need is computed when first asked for, and kept.
  Eigen::MatrixXd inverse(int row, int rows, int column, int columns) const;

 private:
  using Factor = const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Factor L() const { return {L_.storage.data(), size_, size_, Eigen::OuterStride<>(L_.stride)}; }
  const Eigen::MatrixXd& half(int first, int count) const;

  int size_ = 0;
  Triangle L_;
  AlignedBuffer workspace_;
  /// Columns of L^-1 that were asked for, from their first row that is not 0, by first error and their count.
  mutable std::map<std::pair<int, int>, Eigen::MatrixXd> halves_;
};

}  // namespace incognita
