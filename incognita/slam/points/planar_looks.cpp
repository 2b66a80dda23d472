#include "incognita/slam/points/planar_looks.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "incognita/models/planar_frame.hpp"
#include "incognita/models/position_fix.hpp"
#include "incognita/models/range_bearing.hpp"

namespace incognita {
namespace {

using Pose = planar::Pose<double>;

bool uses_first_estimates(const PlanarSlamSettings& s) { return s.filter.lineariser == "first-estimate"; }

/// measured (-) predicted, the bearing wrapped.
Eigen::Vector2d residual_of(const Detection& detection, const Eigen::Vector2d& predicted) {
  const std::array<double, 2> measured{detection.range_m, detection.bearing_rad};
  Eigen::Vector2d residual;
  RangeBearing::chart.minus(measured, {predicted.data(), 2}, {residual.data(), 2});
  return residual;
}

/// An anchor's look: through the vehicle alone, or where the map is told in its frame through the world's
/// pose too.
std::optional<LandmarkLook> look_at_anchor(const PlanarEstimate& e, const Pose& vehicle,
                                           const Eigen::Vector2d& anchor, bool first_estimates) {
  LandmarkLook out;
  if (!e.world) {
    const auto seen = RangeBearing::look(vehicle, anchor);
    const auto derived = first_estimates ? RangeBearing::look(e.first_prediction, anchor) : seen;
    if (!seen || !derived) return std::nullopt;
    out.predicted = seen->z;
    out.look.add(e.vehicle, derived->Hv);
    return out;
  }
  const planar::FramedPoint here = planar::out_of_frame(Pose(e.belief.mean(*e.world)), anchor);
  const auto seen = RangeBearing::look(vehicle, here.point);
  if (!seen) return std::nullopt;
  out.predicted = seen->z;
  out.look.add(e.vehicle, seen->Hv);
  out.look.add(*e.world, (seen->Hl * here.by_frame).eval());
  return out;
}

std::optional<LandmarkLook> look_at_landmark(const PlanarEstimate& e, const Pose& vehicle,
                                             const PlanarLandmark& landmark, bool first_estimates) {
  const Eigen::Vector2d mean = e.belief.mean(landmark.block);
  const auto expected = RangeBearing::look(vehicle, mean);
  const auto derived = first_estimates ? RangeBearing::look(e.first_prediction, landmark.position) : expected;
  if (!expected || !derived) return std::nullopt;
  LandmarkLook out;
  out.predicted = expected->z;
  out.look.add(e.vehicle, derived->Hv);
  out.look.add(landmark.block, derived->Hl);
  return out;
}

}  // namespace

Eigen::Matrix2d detection_noise(const Detection& detection, const RangeBearingSettings& sensor) {
  const double sigma_range = sensor.sigma_range_m + sensor.sigma_range_ratio * detection.range_m;
  return Eigen::Vector2d(sigma_range, sensor.sigma_bearing_rad).cwiseAbs2().asDiagonal();
}

std::optional<LandmarkLook> look_at(const PlanarEstimate& e, const PlanarLandmark& landmark,
                                    const Detection& detection, const PlanarSlamSettings& settings) {
  const Pose vehicle = e.belief.mean(e.vehicle);
  auto out = landmark.anchor ? look_at_anchor(e, vehicle, landmark.position, uses_first_estimates(settings))
                             : look_at_landmark(e, vehicle, landmark, uses_first_estimates(settings));
  if (!out) return out;
  out->look.residual = residual_of(detection, out->predicted);
  out->look.R = detection_noise(detection, settings.sensor);
  return out;
}

AffineLook look_of_fix(const PlanarEstimate& e, const Eigen::Vector2d& fix, double sigma_m) {
  const Pose vehicle = e.belief.mean(e.vehicle);
  AffineLook look;
  if (e.world) {
    const planar::FramedPose seen = planar::in_frame(Pose(e.belief.mean(*e.world)), vehicle);
    look.add(e.vehicle, seen.by_pose.topRows<2>());
    look.add(*e.world, seen.by_frame.topRows<2>());
    look.residual = fix - seen.pose.head<2>();
  } else {
    const PositionFix::Look seen = PositionFix::look(vehicle);
    look.add(e.vehicle, seen.Hv);
    look.residual = fix - seen.z;
  }
  look.R = sigma_m * sigma_m * Eigen::Matrix2d::Identity();
  return look;
}

std::size_t give_birth(PlanarEstimate& e, const Detection& detection, const PlanarSlamSettings& settings) {
  const Pose vehicle = e.belief.mean(e.vehicle);
  RangeBearing::Birth birth = RangeBearing::birth(vehicle, {detection.range_m, detection.bearing_rad});
  if (uses_first_estimates(
          settings)) {  // as the looks to come will be linearised, or they would gain information
    if (const auto look = RangeBearing::look(e.first_prediction, birth.landmark)) {
      birth.Jz = look->Hl.inverse();
      birth.Jv = -birth.Jz * look->Hv;
    }
  }
  const Belief::Parent parent{e.vehicle, birth.Jv};
  PlanarLandmark landmark;
  landmark.id = settings.association.method == "known" ? detection.identity : e.next_id++;
  landmark.identity = detection.identity;
  landmark.position = birth.landmark;
  landmark.block =
      e.belief.augment(RangeBearing::landmark_chart, birth.landmark, {&parent, 1},
                       birth.Jz * detection_noise(detection, settings.sensor) * birth.Jz.transpose());
  landmark.sightings = 1;
  e.catalogue.push_back(landmark);
  return e.catalogue.size() - 1;
}

}  // namespace incognita
