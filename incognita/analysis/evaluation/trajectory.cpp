#include "incognita/analysis/evaluation/trajectory.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

std::vector<std::size_t> in_time_order(const Trajectory& trajectory) {
  std::vector<std::size_t> order(trajectory.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return trajectory[a].t < trajectory[b].t; });
  return order;
}

/// For each pose of `from`, in time order, the index in `to_order` of the nearest pose of `to` in time.
std::vector<std::size_t> nearest(const Trajectory& from, const std::vector<std::size_t>& from_order,
                                 const Trajectory& to, const std::vector<std::size_t>& to_order) {
  std::vector<std::size_t> found(from_order.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < from_order.size(); ++i) {
    const double t = from[from_order[i]].t;
    const auto distance = [&](std::size_t j) { return std::abs(to[to_order[j]].t - t); };
    const auto repeats = [&](std::size_t j) { return to[to_order[j]].t == to[to_order[j - 1]].t; };
    // A repeated time stamp is no nearer, but must not end the search
    while (k + 1 < to_order.size() && (distance(k + 1) < distance(k) || repeats(k + 1))) ++k;
    found[i] = k;
  }
  return found;
}

Eigen::Matrix3Xd positions(const Trajectory& trajectory) {
  Eigen::Matrix3Xd p(3, trajectory.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    p.col(static_cast<Eigen::Index>(i)) = trajectory[i].position;
  return p;
}

Alignment from_umeyama(const Eigen::Matrix4d& similarity) {
  Alignment alignment;
  alignment.scale = std::cbrt(similarity.topLeftCorner<3, 3>().determinant());
  alignment.rotation = similarity.topLeftCorner<3, 3>() / alignment.scale;
  alignment.translation = similarity.topRightCorner<3, 1>();
  return alignment;
}

/// Least squares over the heading only: the rotation about z between the centered (x, y) of both.
Alignment yaw_alignment(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Vector3d mean_from = from.rowwise().mean(), mean_to = to.rowwise().mean();
  const Eigen::Matrix3Xd a = from.colwise() - mean_from, b = to.colwise() - mean_to;
  const double sine = a.row(0).dot(b.row(1)) - a.row(1).dot(b.row(0));
  const double cosine = a.row(0).dot(b.row(0)) + a.row(1).dot(b.row(1));
  Alignment alignment;
  alignment.rotation = rotation_exp<double>(Eigen::Vector3d(0, 0, std::atan2(sine, cosine)));
  alignment.translation = mean_to - alignment.rotation * mean_from;
  return alignment;
}

/// Whether the positions differ by more than rounding.
bool has_extent(const Eigen::Matrix3Xd& p) {
  const Eigen::Vector3d mean = p.rowwise().mean();
  return (p.colwise() - mean).colwise().norm().maxCoeff() > 1e-12 * (1 + mean.norm());
}

struct RelativePose {
  Eigen::Vector3d translation;
  Eigen::Vector4d rotation;
};

/// first_from_second.
RelativePose between(const StampedPose& first, const StampedPose& second) {
  const Eigen::Vector4d inverse = quaternion_conjugate<double>(first.orientation);
  return {rotation_matrix<double>(inverse) * (second.position - first.position),
          quaternion_product<double>(inverse, second.orientation)};
}

/// Index of the pose an interval after pose i; empty if there is none.
std::optional<std::size_t> later(const Trajectory& truth, std::size_t i, const RelativeInterval& interval) {
  if (interval.frames > 0) {
    const std::size_t j = i + static_cast<std::size_t>(interval.frames);
    return j < truth.size() ? std::optional(j) : std::nullopt;
  }
  const double wanted = truth[i].t + interval.seconds;
  const auto first = truth.begin() + static_cast<std::ptrdiff_t>(i) + 1;
  auto after = std::lower_bound(first, truth.end(), wanted,
                                [](const StampedPose& pose, double t) { return pose.t < t; });
  const bool past_the_end = after == truth.end();
  if (past_the_end || (after != first && wanted - std::prev(after)->t < after->t - wanted)) {
    if (after == first) return std::nullopt;
    --after;
  }
  // Past the end every pose would match the last one, at ever shorter intervals: only a small tolerance applies
  const double tolerance = (past_the_end ? 0.01 : 0.1) * interval.seconds;
  if (std::abs(after->t - wanted) > tolerance) return std::nullopt;
  return static_cast<std::size_t>(after - truth.begin());
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> associate(const Trajectory& estimate,
                                                           const Trajectory& truth, double max_dt_s) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (estimate.empty() || truth.empty()) return pairs;
  const auto estimate_order = in_time_order(estimate), truth_order = in_time_order(truth);
  const auto to_truth = nearest(estimate, estimate_order, truth, truth_order);
  const auto to_estimate = nearest(truth, truth_order, estimate, estimate_order);
  for (std::size_t i = 0; i < to_truth.size(); ++i) {
    if (to_estimate[to_truth[i]] != i) continue;
    const std::size_t e = estimate_order[i], g = truth_order[to_truth[i]];
    if (std::abs(estimate[e].t - truth[g].t) <= max_dt_s) pairs.emplace_back(e, g);
  }
  return pairs;
}

MatchedTrajectories match(const Trajectory& estimate, const Trajectory& truth, double max_dt_s) {
  MatchedTrajectories matched;
  for (const auto& [e, g] : associate(estimate, truth, max_dt_s)) {
    matched.estimate.push_back(estimate[e]);
    matched.truth.push_back(truth[g]);
  }
  return matched;
}

const char* name(AlignmentKind kind) {
  switch (kind) {
    case AlignmentKind::none:
      return "none";
    case AlignmentKind::se3:
      return "se3";
    case AlignmentKind::sim3:
      return "sim3";
    case AlignmentKind::yaw:
      return "yaw";
  }
  return "unknown";
}

std::optional<AlignmentKind> alignment_kind(std::string_view word) {
  for (const AlignmentKind kind :
       {AlignmentKind::none, AlignmentKind::se3, AlignmentKind::sim3, AlignmentKind::yaw})
    if (word == name(kind)) return kind;
  return std::nullopt;
}

std::optional<Alignment> align(const MatchedTrajectories& matched, AlignmentKind kind) {
  if (kind == AlignmentKind::none) return Alignment{};
  if (matched.estimate.empty()) return std::nullopt;
  const Eigen::Matrix3Xd from = positions(matched.estimate), to = positions(matched.truth);
  if (kind == AlignmentKind::yaw) return yaw_alignment(from, to);
  const bool with_scale = kind == AlignmentKind::sim3;
  // The scale would be zero if the truth never moved, and infinite if the estimate never moved
  if (with_scale && (!has_extent(from) || !has_extent(to))) return std::nullopt;
  return from_umeyama(Eigen::umeyama(from, to, with_scale));
}

Trajectory aligned(const Trajectory& estimate, const Alignment& alignment) {
  const Eigen::Vector4d turn = quaternion_from_matrix(alignment.rotation);
  Trajectory result = estimate;
  for (StampedPose& pose : result) {
    pose.position = alignment.scale * (alignment.rotation * pose.position) + alignment.translation;
    pose.orientation = quaternion_product<double>(turn, pose.orientation).normalized();
  }
  return result;
}

ErrorStatistics statistics(std::vector<double> errors) {
  ErrorStatistics s;
  s.count = errors.size();
  if (errors.empty()) return s;
  std::sort(errors.begin(), errors.end());
  const std::size_t middle = errors.size() / 2;
  s.median = errors.size() % 2 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  s.max = errors.back();
  double squares = 0;
  for (const double e : errors) {
    s.mean += e;
    squares += e * e;
  }
  s.mean /= static_cast<double>(errors.size());
  s.rmse = std::sqrt(squares / static_cast<double>(errors.size()));
  return s;
}

ErrorStatistics absolute_trajectory_error(const MatchedTrajectories& matched) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < matched.estimate.size(); ++i)
    distances.push_back((matched.estimate[i].position - matched.truth[i].position).norm());
  return statistics(std::move(distances));
}

RelativePoseError relative_pose_error(const MatchedTrajectories& matched, const RelativeInterval& interval) {
  std::vector<double> translations, rotations;
  for (std::size_t i = 0; i < matched.truth.size(); ++i) {
    const auto j = later(matched.truth, i, interval);
    if (!j) continue;
    if (!matched.truth[i].oriented || !matched.estimate[i].oriented) continue;
    const RelativePose moved = between(matched.truth[i], matched.truth[*j]);
    const RelativePose estimated = between(matched.estimate[i], matched.estimate[*j]);
    // (first_from_second_true)^-1 * first_from_second_estimated: its norms do not depend on the frame
    translations.push_back((estimated.translation - moved.translation).norm());
    const Eigen::Vector4d turn =
        quaternion_product<double>(quaternion_conjugate<double>(moved.rotation), estimated.rotation);
    rotations.push_back(quaternion_log<double>(turn).norm());
  }
  return {statistics(std::move(translations)), statistics(std::move(rotations))};
}

}  // namespace incognita
