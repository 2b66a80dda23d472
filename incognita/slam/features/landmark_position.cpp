#include "incognita/slam/features/estimate.hpp"

namespace incognita {
namespace {

LandmarkPosition at_depth(const Landmark& landmark, const Belief& belief) {
  InverseDepthLandmark::State y;
  y.head<5>() = belief.mean(landmark.block).head<5>();
  double mean = 0, square = 0;  // of the depth along the initial optical axis
  for (const auto& particle : landmark.particles) {
    const double depth = 1 / particle.inverse_depth;
    mean += particle.weight * depth;
    square += particle.weight * depth * depth;
  }
  y[5] = 1 / mean;
  const auto point = landmark.initial_axes.point(y);
  const Eigen::Matrix<double, 3, 5> J = point.J.leftCols<5>();
  const Eigen::Vector3d along = (point.position - y.head<3>()) / mean;
  return {point.position, J * belief.covariance(landmark.block) * J.transpose() +
                              (square - mean * mean) * along * along.transpose()};
}

}  // namespace

std::optional<LandmarkPosition> position_of(const Landmark& landmark, const Belief& belief) {
  switch (landmark.kind) {
    case Landmark::Kind::anchor:
      return LandmarkPosition{landmark.anchor, Eigen::Matrix3d::Zero()};
    case Landmark::Kind::point:
      return LandmarkPosition{belief.mean(landmark.block), belief.covariance(landmark.block)};
    case Landmark::Kind::line:
      return at_depth(landmark, belief);
    case Landmark::Kind::inverse_depth:
      break;
  }
  const InverseDepthLandmark::State y = belief.mean(landmark.block);
  if (!(y[5] > 1e-6)) return std::nullopt;
  const auto point = landmark.initial_axes.point(y);
  return LandmarkPosition{point.position, point.J * belief.covariance(landmark.block) * point.J.transpose()};
}

}  // namespace incognita
