#include "incognita/slam/mapper/relative_sigma.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {
namespace {

using Axes = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_block_size>;

/// A point in the map frame as a function of one block; none for an anchor in a world-frame map.
struct MapPoint {
  Eigen::Vector3d position{0, 0, 0};  ///< coordinates that a place does not have are 0
  std::optional<BlockId> block;
  Axes J;  ///< d(position) / d(error of the block)
  bool depth_known = true;
};

MapPoint in_space(const SmallVector& position, std::optional<BlockId> block, const SmallMatrix& J) {
  MapPoint point;
  point.position.head(position.size()) = position;
  point.block = block;
  if (!block) return point;
  point.J = Axes::Zero(3, J.cols());
  point.J.topRows(J.rows()) = J;
  return point;
}

std::optional<MapPoint> point_of_landmark(const Estimate& e, std::int64_t id) {
  const auto found = e.landmarks.find(id);
  if (found == e.landmarks.end()) return std::nullopt;
  const Landmark& landmark = found->second;
  if (landmark.fixed && !e.world) return in_space(landmark.position, std::nullopt, {});
  if (landmark.fixed) {
    const planar::FramedPoint at = planar::out_of_frame(planar::Pose<double>(e.belief.mean(*e.world)),
                                                        Eigen::Vector2d(landmark.position));
    return in_space(at.point, *e.world, at.by_frame);
  }
  const auto at = position_of(landmark.form, e.belief.mean(landmark.block));
  if (!at) return std::nullopt;
  MapPoint point = in_space(at->position, landmark.block, at->J);
  point.depth_known = landmark.form.kind == LandmarkParametrization::Kind::point;
  return point;
}

std::optional<MapPoint> point_of(const Estimate& e, const MatchedTarget& target,
                                 const EstimatorSettings& settings) {
  if (!target.of_body) return point_of_landmark(e, target.id);
  const auto body = static_cast<std::size_t>(target.id);
  const BlockId block = e.bodies[body].block;
  const AnyPoint at = position_of(settings.bodies[body].motion, e.belief.mean(block));
  return in_space(at.position, block, at.J);
}

/// Pose of a body in the map frame, with its Jacobian.
struct MapPose {
  RigidPose pose;
  SmallMatrix J;  ///< d(position, right rotation error) / d(error of the body)
};
MapPose pose_in_map(const Estimate& e, std::size_t body, const EstimatorSettings& settings) {
  const AnyMotion& motion = settings.bodies[body].motion;
  const SmallVector state = e.belief.mean(e.bodies[body].block);
  return {pose_of(motion, state), pose_jacobian(motion, state)};
}

/// Of r = R' (l - p), a point l as seen from a body at p, in its axes: dr = R' (dl - dp) + [r] theta with the right
/// rotation error theta. In these axes it does not depend on the heading in the world, which may be unobservable, too.
Eigen::Matrix3d relative_covariance(const Estimate& e, BlockId body, const MapPose& from,
                                    const MapPoint& to) {
  const Eigen::Matrix3d Rt = rotation_matrix<double>(from.pose.world_from_body).transpose();
  const Eigen::Vector3d r = Rt * (to.position - from.pose.position);
  const Axes by_body = -Rt * from.J.topRows(3) + skew<double>(r) * from.J.bottomRows(3);
  Eigen::Matrix3d P = by_body * e.belief.covariance(body) * by_body.transpose();
  if (to.block && *to.block != body) {
    const Axes by_point = Rt * to.J;
    const Eigen::Matrix3d cross = by_body * e.belief.covariance(body, *to.block) * by_point.transpose();
    P += by_point * e.belief.covariance(*to.block) * by_point.transpose() + cross + cross.transpose();
  }
  if (to.depth_known || !(r.squaredNorm() > 0)) return P;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - r * r.transpose() / r.squaredNorm();
  return across * P * across;
}

double largest_sigma(const Eigen::Matrix3d& P) {
  return std::sqrt(std::max(0.0, P.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
}

/// A target of a match that corrected the filter; nothing when it has no position.
std::optional<MatchedTarget> target_of(const Estimate& e, const Match& match,
                                       const EstimatorSettings& settings) {
  const auto body = static_cast<std::size_t>(match.body);
  MatchedTarget target{match.of_body, match.id, 0};
  const auto to = point_of(e, target, settings);
  if (!to) return std::nullopt;
  const AnyMotion& motion = settings.bodies[body].motion;
  const RigidPose from = pose_of(motion, e.belief.mean(e.bodies[body].block));
  target.distance_m = (to->position - from.position).norm();
  return target.distance_m > 0 ? std::optional(target) : std::nullopt;
}

}  // namespace

void note_matched(Estimate& e, const std::vector<Match>& in_images, const EstimatorSettings& settings) {
  for (std::size_t body = 0; body < e.bodies.size(); ++body) {
    std::vector<MatchedTarget>& targets = e.bodies[body].matched_last;
    bool has_new = false;
    for (const std::vector<Match>* matches : {&std::as_const(e.last.matches), &in_images})
      for (const Match& match : *matches) {
        if (match.outcome != MatchOutcome::matched || match.ray || match.body != static_cast<int>(body))
          continue;
        const auto target = target_of(e, match, settings);
        if (!target) continue;
        if (!std::exchange(has_new, true)) targets.clear();
        targets.push_back(*target);
      }
  }
}

std::optional<RelativeSigma> relative_sigma(const Estimate& e, std::size_t body,
                                            const EstimatorSettings& settings) {
  const std::vector<MatchedTarget>& targets = e.bodies[body].matched_last;
  if (targets.empty()) return std::nullopt;
  const MapPose from = pose_in_map(e, body, settings);
  std::vector<RelativeSigma> sigmas;
  for (const MatchedTarget& target : targets)
    if (const auto to = point_of(e, target, settings))
      sigmas.push_back(
          {largest_sigma(relative_covariance(e, e.bodies[body].block, from, *to)), target.distance_m});
  if (sigmas.empty()) return std::nullopt;
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end(),
                   [](const RelativeSigma& a, const RelativeSigma& b) { return a.ratio() < b.ratio(); });
  return *middle;
}

}  // namespace incognita
