#include "incognita/slam/points/team_estimate.hpp"

#include <Eigen/LU>

#include "incognita/math/gaussian.hpp"
#include "incognita/models/planar_frame.hpp"
#include "incognita/slam/mapper/belief_entropy.hpp"

namespace incognita {
namespace {

/// Position in the world of a landmark of a map in the vehicle frame.
TeamPosition out_of_vehicle_frame(const TeamLandmark& landmark, const TeamEstimate& e) {
  const Eigen::Vector2d mean = e.belief.mean(landmark.block);
  const planar::FramedPoint at = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)), mean);
  const SmallMatrix cross =
      at.by_point * e.belief.covariance(landmark.block, *e.world) * at.by_frame.transpose();
  return {at.point, at.by_frame * e.belief.covariance(*e.world) * at.by_frame.transpose() +
                        at.by_point * e.belief.covariance(landmark.block) * at.by_point.transpose() + cross +
                        cross.transpose()};
}

int vehicle_errors(const TeamEstimate& e) {
  int errors = 0;
  for (const TeamVehicle& vehicle : e.vehicles) errors += e.belief.chart(vehicle.block).tangent();
  return errors;
}

/// Entropies with a block-diagonal map: sums over its blocks, and the Schur complement of the vehicle for the total.
Entropy entropies_of_arrow(const TeamEstimate& e) {
  const BlockId vehicle = e.vehicles.front().block;
  double map = 0;
  int errors = 0;
  Eigen::MatrixXd left = e.belief.covariance(vehicle);
  for (const auto& [identity, landmark] : e.landmarks) {
    const Eigen::MatrixXd own = e.belief.covariance(landmark.block);
    const Eigen::MatrixXd cross = e.belief.covariance(vehicle, landmark.block);
    map += log_det(own);
    left -= cross * own.inverse() * cross.transpose();
    errors += static_cast<int>(own.rows());
  }
  const int own = static_cast<int>(left.rows());
  return {gaussian_entropy(log_det(Eigen::MatrixXd(e.belief.covariance(vehicle))), own),
          gaussian_entropy(map, errors), gaussian_entropy(map + log_det(left), errors + own)};
}

/// Entropies of a map in the vehicle frame: the pose is that of the world relative to the vehicle.
Entropy entropies_in_vehicle_frame(const TeamEstimate& e) {
  const Eigen::MatrixXd P = e.belief.dense_covariance();
  const Eigen::Index first = e.belief.offset(*e.world), rest = P.rows() - first - 3;
  const int errors = static_cast<int>(rest);
  return {gaussian_entropy(log_det(P.block(first, first, 3, 3)), 3),
          rest > 0 ? gaussian_entropy(log_det(P.bottomRightCorner(rest, rest)), errors) : 0,
          gaussian_entropy(log_det(P.bottomRightCorner(rest + 3, rest + 3)), errors + 3)};
}

}  // namespace

std::optional<TeamPosition> position_of(const TeamLandmark& landmark, const TeamEstimate& e) {
  if (e.world) return out_of_vehicle_frame(landmark, e);
  const auto at = position_of(landmark.form, e.belief.mean(landmark.block));
  if (!at) return std::nullopt;
  return TeamPosition{at->position, at->J * e.belief.covariance(landmark.block) * at->J.transpose()};
}

Entropy entropies(const TeamEstimate& e) {
  if (e.belief.drops_correlations()) return entropies_of_arrow(e);
  if (e.world) return entropies_in_vehicle_frame(e);
  return entropies_of(e.belief, vehicle_errors(e));
}

}  // namespace incognita
