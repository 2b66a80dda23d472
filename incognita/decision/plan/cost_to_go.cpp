#include "incognita/decision/plan/cost_to_go.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/decision/plan/expected_surface.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita {

double time_to_view_s(const Eigen::Vector3d& position, const Eigen::Vector3d& ahead,
                      const ExpectedLandmark& landmark, const Reach& reach) {
  const Eigen::Vector3d way = landmark.position - position;
  const double distance_m = way.norm();
  double move_m = std::max(0.0, distance_m - reach.distance_m);
  if (!landmark.normal.isZero()) {
    // Along the surface, until it is seen under the least angle
    const double height_m = std::max(0.0, -way.dot(landmark.normal));
    const double along_m = std::sqrt(std::max(0.0, distance_m * distance_m - height_m * height_m));
    const double cotangent = std::sqrt(1 / (least_sine_to_surface * least_sine_to_surface) - 1);
    move_m = std::max(move_m, along_m - cotangent * height_m);
  }
  const double angle_rad = distance_m > 0 ? std::acos(std::clamp(ahead.dot(way) / distance_m, -1.0, 1.0)) : 0;
  const double turn_rad = std::max(0.0, angle_rad - reach.half_view_rad);
  return std::max(move_m > 0 ? move_m / reach.speed_m_s : 0,
                  turn_rad > 0 ? turn_rad / reach.turn_rate_rad_s : 0);
}

double information_to_go(const BlockVector& state, std::span<const ExpectedLandmark> expected,
                         const PlannedMap& map, const ImaginedMap& imagined, const Resolution& resolution,
                         const Reach& reach, double start_s, double discount_s) {
  const Eigen::Vector3d position = state.head<3>();
  const Eigen::Matrix3d R = rotation_matrix<double>(Eigen::Vector4d(state.segment<4>(3)));
  const Eigen::Vector3d ahead = R.col(2);
  double nats = 0;
  for (const ExpectedLandmark& landmark : expected) {
    const double missing =
        imagined.missing_about(map, landmark.index, landmark.position - position, R, resolution);
    if (missing <= 0) continue;
    const double t = start_s + time_to_view_s(position, ahead, landmark, reach);
    nats += landmark.probability * missing * std::exp(-t / discount_s);
  }
  return nats;
}

}  // namespace incognita
