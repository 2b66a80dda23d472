#include "incognita/slam/mapper/estimate.hpp"

#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {
namespace {

/// Position in the world of a landmark of a map in the vehicle frame.
LandmarkPosition out_of_vehicle_frame(const Landmark& landmark, const Estimate& e) {
  const Eigen::Vector2d mean = e.belief.mean(landmark.block);
  const planar::FramedPoint at = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)), mean);
  const SmallMatrix cross =
      at.by_point * e.belief.covariance(landmark.block, *e.world) * at.by_frame.transpose();
  return {at.point, at.by_frame * e.belief.covariance(*e.world) * at.by_frame.transpose() +
                        at.by_point * e.belief.covariance(landmark.block) * at.by_point.transpose() + cross +
                        cross.transpose()};
}

}  // namespace

std::optional<LandmarkPosition> position_of(const Landmark& landmark, const Estimate& e) {
  if (landmark.fixed) {
    const Eigen::Index size = landmark.position.size();
    return LandmarkPosition{landmark.position, SmallMatrix::Zero(size, size)};
  }
  if (e.world) return out_of_vehicle_frame(landmark, e);
  const auto at = position_of(landmark.form, e.belief.mean(landmark.block));
  if (!at) return std::nullopt;
  return LandmarkPosition{at->position, at->J * e.belief.covariance(landmark.block) * at->J.transpose()};
}

}  // namespace incognita
