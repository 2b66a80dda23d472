#include "incognita/analysis/evaluation/pose_consistency.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "incognita/math/chart.hpp"

namespace incognita {
namespace {

constexpr Chart pose_chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};
/// 0.9973 quantile of chi-square by degrees of freedom, i.e. 3 sigma.
constexpr double three_sigma_chi_square[] = {0, 8.9998, 11.829, 14.156};

using PoseNumbers = Eigen::Matrix<double, 7, 1>;
PoseNumbers numbers(const StampedPose& pose) {
  PoseNumbers x;
  x << pose.position, pose.orientation;
  return x;
}

/// Normalized square of the given components, except those with unknown error (NaN) and those exact by
/// construction (error and variance 0). `on_plane`: also without height, roll and pitch.
template <int N>
std::optional<NormalizedSquare> normalized_square(const Eigen::Matrix<double, N, 1>& e,
                                                  const Eigen::Matrix<double, N, N>& P,
                                                  std::initializer_list<int> components, bool on_plane) {
  std::vector<int> states;
  for (const int i : components)
    if (!std::isnan(e[i]) && !(e[i] == 0 && P(i, i) == 0) && !(on_plane && i >= 2 && i <= 4))
      states.push_back(i);
  if (states.empty()) return std::nullopt;
  const Eigen::MatrixXd part = P(states, states);
  const Eigen::LLT<Eigen::MatrixXd> factor(part);
  if (factor.info() != Eigen::Success) return std::nullopt;
  // A pivot at rounding level means that some combination has no uncertainty
  constexpr double least = 1e-6;  // relative to the standard deviation
  for (Eigen::Index i = 0; i < part.rows(); ++i)
    if (!(factor.matrixLLT()(i, i) > least * std::sqrt(part(i, i)))) return std::nullopt;
  return NormalizedSquare{factor.matrixL().solve(Eigen::VectorXd(e(states))).squaredNorm(),
                          static_cast<int>(states.size())};
}

}  // namespace

PoseError pose_error(const StampedPose& truth, const StampedPose& estimate) {
  const PoseNumbers y = numbers(truth), x = numbers(estimate);
  PoseError error;
  pose_chart.minus({y.data(), 7}, {x.data(), 7}, {error.data(), 6});
  if (!truth.oriented || !estimate.oriented)
    error.tail<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
  return error;
}

std::optional<NormalizedSquare> pose_normalized_square(const PoseError& error,
                                                       const PoseCovariance& covariance) {
  // A filter on a plane has no such states, and true uneven ground does not make them an error of it
  const bool on_plane = covariance.diagonal().segment<3>(2).isZero(0);
  auto square = normalized_square<6>(error, covariance, {0, 1, 2, 3, 4, 5}, on_plane);
  // False if height, roll and pitch are no states
  const bool follow = (covariance.diagonal().segment<3>(2).array() > 0).all();
  if (!square && follow) square = normalized_square<6>(error, covariance, {0, 1, 5}, false);
  return square;
}

std::optional<double> pose_nees(const PoseError& error, const PoseCovariance& covariance) {
  const auto square = pose_normalized_square(error, covariance);
  if (!square) return std::nullopt;
  return square->sum / square->degrees_of_freedom;
}

bool beyond_three_sigma(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  auto square = normalized_square<3>(error, covariance, {0, 1, 2}, covariance(2, 2) == 0);
  if (!square && covariance(2, 2) > 0) square = normalized_square<3>(error, covariance, {0, 1}, false);
  if (!square) return !error.isZero();
  return square->sum > three_sigma_chi_square[square->degrees_of_freedom];
}

std::optional<MeanNees> mean_pose_nees(const MatchedTrajectories& matched,
                                       const std::vector<StampedCovariance>& covariances) {
  std::vector<StampedCovariance> sorted = covariances;
  const auto before = [](const StampedCovariance& a, const StampedCovariance& b) { return a.t < b.t; };
  std::stable_sort(sorted.begin(), sorted.end(), before);
  double sum = 0;
  std::size_t count = 0;
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
  return MeanNees{sum / static_cast<double>(count), count};
}

}  // namespace incognita
