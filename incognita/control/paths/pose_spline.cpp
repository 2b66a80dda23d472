#include "incognita/control/paths/pose_spline.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace incognita {
namespace {

using Eigen::Index;
using Eigen::Matrix4Xd;
using Eigen::VectorXd;

void check(const VectorXd& t, const Matrix4Xd& pose) {
  if (t.size() != pose.cols() || t.size() < 2) {
    throw std::invalid_argument("a path needs two samples or more, each with its time: there are " +
                                std::to_string(pose.cols()) + " and " + std::to_string(t.size()) + " times");
  }
  if (!t.allFinite() || !pose.allFinite()) throw std::invalid_argument("a sample of the path is not finite");
  for (Index i = 1; i < t.size(); ++i) {
    if (t[i] > t[i - 1]) continue;
    throw std::invalid_argument("sample " + std::to_string(i + 1) + " of the path is at " +
                                std::to_string(t[i]) + " s, not later than the one before");
  }
}

/// Second derivatives at the samples, from the continuity of the first; the matrix is symmetric positive definite.
Matrix4Xd bending_of(const VectorXd& t, const Matrix4Xd& pose) {
  const Index inner = t.size() - 2;
  Matrix4Xd bending = Matrix4Xd::Zero(4, t.size());
  if (inner < 1) return bending;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX4d right(inner, 4);
  for (Index i = 0; i < inner; ++i) {
    const double before = t[i + 1] - t[i], after = t[i + 2] - t[i + 1];
    entries.emplace_back(i, i, 2 * (before + after));
    if (i > 0) entries.emplace_back(i, i - 1, before);
    if (i + 1 < inner) entries.emplace_back(i, i + 1, after);
    right.row(i) =
        6 * ((pose.col(i + 2) - pose.col(i + 1)) / after - (pose.col(i + 1) - pose.col(i)) / before);
  }
  Eigen::SparseMatrix<double> A(inner, inner);
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(A);
  const Eigen::MatrixX4d solution = solver.solve(right);
  bending.middleCols(1, inner) = solution.transpose();
  if (solver.info() != Eigen::Success || !bending.allFinite())
    throw std::invalid_argument("the samples of the path are too far apart for their times");
  return bending;
}

}  // namespace

PoseSpline pose_spline(const VectorXd& t, const Matrix4Xd& pose) {
  check(t, pose);
  return {t, pose, bending_of(t, pose)};
}

PoseMotion at(const PoseSpline& s, double t) {
  t = std::clamp(t, s.t[0], s.t[s.t.size() - 1]);
  const auto later = std::upper_bound(s.t.begin() + 1, s.t.end() - 1, t);
  const Index i = later - s.t.begin() - 1;
  const double h = s.t[i + 1] - s.t[i], b = (t - s.t[i]) / h, a = 1 - b;
  const auto pose_0 = s.pose.col(i), pose_1 = s.pose.col(i + 1), bend_0 = s.bending.col(i),
             bend_1 = s.bending.col(i + 1);
  return {a * pose_0 + b * pose_1 + ((a * a * a - a) * bend_0 + (b * b * b - b) * bend_1) * (h * h / 6),
          (pose_1 - pose_0) / h + ((1 - 3 * a * a) * bend_0 + (3 * b * b - 1) * bend_1) * (h / 6),
          a * bend_0 + b * bend_1};
}

}  // namespace incognita
