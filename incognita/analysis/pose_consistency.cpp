#include "incognita/analysis/pose_consistency.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "incognita/math/chart.hpp"

namespace incognita {
namespace {

constexpr Chart pose_chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};
constexpr double three_sigma_chi_square_3 = 14.156;  // F^-1(0.9973)

using PoseNumbers = Eigen::Matrix<double, 7, 1>;
PoseNumbers numbers(const StampedPose& pose) {
  PoseNumbers x;
  x << pose.position, pose.orientation;
  return x;
}

/// e' P^-1 e.
template <int N>
std::optional<double> normalised_square(const Eigen::Matrix<double, N, 1>& e,
                                        const Eigen::Matrix<double, N, N>& P) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(P);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.matrixL().solve(e).squaredNorm();
}

}  // namespace

PoseError pose_error(const StampedPose& truth, const StampedPose& estimate) {
  const PoseNumbers y = numbers(truth), x = numbers(estimate);
  PoseError error;
  pose_chart.minus({y.data(), 7}, {x.data(), 7}, {error.data(), 6});
  return error;
}

std::optional<double> pose_nees(const PoseError& error, const PoseCovariance& covariance) {
  const auto sum = normalised_square<6>(error, covariance);
  if (!sum) return std::nullopt;
  return *sum / 6;
}

bool beyond_three_sigma(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  const auto distance_squared = normalised_square<3>(error, covariance);
  if (!distance_squared) return !error.isZero();
  return *distance_squared > three_sigma_chi_square_3;
}

std::optional<double> mean_pose_nees(const MatchedTrajectories& matched,
                                     const std::vector<StampedCovariance>& covariances) {
  std::vector<StampedCovariance> sorted = covariances;
  const auto before = [](const StampedCovariance& a, const StampedCovariance& b) { return a.t < b.t; };
  std::stable_sort(sorted.begin(), sorted.end(), before);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < matched.estimate.size(); ++i) {
    const auto found =
        std::lower_bound(sorted.begin(), sorted.end(), StampedCovariance{matched.estimate[i].t, {}}, before);
    if (found == sorted.end() || found->t != matched.estimate[i].t) continue;
    const auto nees = pose_nees(pose_error(matched.truth[i], matched.estimate[i]), found->covariance);
    if (!nees) continue;
    sum += *nees;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace incognita
