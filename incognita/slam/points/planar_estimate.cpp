#include "incognita/slam/points/planar_estimate.hpp"

#include <Eigen/LU>

#include "incognita/math/gaussian.hpp"
#include "incognita/models/planar_frame.hpp"

namespace incognita {

PlanarPoseEstimate vehicle_pose(const PlanarEstimate& e) {
  const planar::Pose<double> vehicle = e.belief.mean(e.vehicle);
  if (!e.world) return {vehicle, e.belief.covariance(e.vehicle)};
  const planar::FramedPose seen = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)), vehicle);
  const Eigen::Matrix3d cross =
      seen.by_pose * e.belief.covariance(e.vehicle, *e.world) * seen.by_frame.transpose();
  return {seen.pose, seen.by_frame * e.belief.covariance(*e.world) * seen.by_frame.transpose() +
                         seen.by_pose * e.belief.covariance(e.vehicle) * seen.by_pose.transpose() + cross +
                         cross.transpose()};
}

PlanarPosition position_of(const PlanarLandmark& landmark, const PlanarEstimate& e) {
  if (landmark.anchor) return {landmark.position, Eigen::Matrix2d::Zero()};
  const Eigen::Vector2d mean = e.belief.mean(landmark.block);
  if (!e.world) return {mean, e.belief.covariance(landmark.block)};
  const planar::FramedPoint seen = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)), mean);
  const Eigen::Matrix2d cross =
      seen.by_point * e.belief.covariance(landmark.block, *e.world) * seen.by_frame.transpose();
  return {seen.point, seen.by_frame * e.belief.covariance(*e.world) * seen.by_frame.transpose() +
                          seen.by_point * e.belief.covariance(landmark.block) * seen.by_point.transpose() +
                          cross + cross.transpose()};
}

namespace {

/// Of a map whose blocks are not correlated: sums over them, and for all together the vehicle's Schur
/// complement.
Entropy entropies_of_arrow(const PlanarEstimate& e) {
  double map = 0;
  int errors = 0;
  Eigen::Matrix3d left = e.belief.covariance(e.vehicle);
  for (const PlanarLandmark& landmark : e.catalogue) {
    if (landmark.anchor) continue;
    const Eigen::Matrix2d own = e.belief.covariance(landmark.block);
    const Eigen::Matrix<double, 3, 2> cross = e.belief.covariance(e.vehicle, landmark.block);
    map += log_det(own);
    left -= cross * own.inverse() * cross.transpose();
    errors += 2;
  }
  const double vehicle = log_det(Eigen::Matrix3d(e.belief.covariance(e.vehicle)));
  return {gaussian_entropy(vehicle, 3), gaussian_entropy(map, errors),
          gaussian_entropy(map + log_det(left), errors + 3)};
}

}  // namespace

Entropy entropies(const PlanarEstimate& e) {
  if (e.belief.correlations() == MapCorrelations::dropped) return entropies_of_arrow(e);
  const BlockId pose = e.world ? *e.world : e.vehicle;
  const Eigen::MatrixXd P = e.belief.dense_covariance();
  const Eigen::Index first = e.belief.offset(pose), rest = P.rows() - first - 3;
  const int errors = static_cast<int>(rest);
  return {gaussian_entropy(log_det(P.block(first, first, 3, 3)), 3),
          rest > 0 ? gaussian_entropy(log_det(P.bottomRightCorner(rest, rest)), errors) : 0,
          gaussian_entropy(log_det(P.bottomRightCorner(rest + 3, rest + 3)), errors + 3)};
}

}  // namespace incognita
