// Exact derivatives of a templated function, by Eigen's automatic differentiation.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

namespace Eigen {
/// An integer has no derivative.
template <class D>
auto floor(const AutoDiffScalar<D>& x) {
  using Derivatives = typename internal::remove_all<D>::type::PlainObject;
  return AutoDiffScalar<Derivatives>(std::floor(x.value()), Derivatives::Zero());
}
}  // namespace Eigen

namespace incognita {

/// Dual number with derivatives with respect to N variables. The size is fixed, so that a constant has zero
/// derivatives instead of an empty vector.
template <int N>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;

/// x as the variables first, first + 1, ... of N.
template <int N, class V>
auto variables(const V& x, int first = 0) {
  Eigen::Matrix<Dual<N>, V::RowsAtCompileTime, 1> dual(x.size());
  for (int i = 0; i < x.size(); ++i) dual[i] = Dual<N>(x[i], N, first + i);
  return dual;
}

/// dy/dx, one row per component of y.
template <int N, int Rows>
Eigen::Matrix<double, Rows, N> derivatives(const Eigen::Matrix<Dual<N>, Rows, 1>& y) {
  Eigen::Matrix<double, Rows, N> J(y.size(), N);
  for (int i = 0; i < y.size(); ++i) J.row(i) = y[i].derivatives().transpose();
  return J;
}

/// y without its derivatives.
template <int N, int Rows>
Eigen::Matrix<double, Rows, 1> values(const Eigen::Matrix<Dual<N>, Rows, 1>& y) {
  Eigen::Matrix<double, Rows, 1> plain(y.size());
  for (int i = 0; i < y.size(); ++i) plain[i] = y[i].value();
  return plain;
}

}  // namespace incognita
