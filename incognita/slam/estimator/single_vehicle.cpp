#include "incognita/slam/estimator/single_vehicle.hpp"

#include <stdexcept>

namespace incognita {
namespace {

BodyModel body_of(const PlanarSlamSettings& s) {
  if (!motion_traits_of(s.vehicle.model).is_planar_pose())
    throw std::invalid_argument("vehicle.model = `" + s.vehicle.model +
                                "`: must be one of `ackermann`, `differential-drive`");
  BodyModel body;
  body.motion = motion_of(s.vehicle);
  const PlanarStartSettings& start = s.start;
  body.start = Eigen::Vector3d(start.position_m.x(), start.position_m.y(), wrap_angle(start.heading_rad));
  body.start_sigmas =
      Eigen::Vector3d(start.sigma_position_m, start.sigma_position_m, start.sigma_heading_rad);
  body.input_sigmas = input_sigmas_of(s.vehicle, traits_of(body.motion));
  body.sigma_fix_m = s.filter.use_fixes ? s.filter.sigma_fix_m : 0;
  body.start_time =
      start.at_first_fix ? BodyModel::StartTime::first_fix : BodyModel::StartTime::first_reading;
  PointSensor sensor{RangeBearingSensor{},
                     Eigen::Vector2d(s.sensor.sigma_range_m, s.sensor.sigma_bearing_rad)};
  sensor.sigma_range_ratio = s.sensor.sigma_range_ratio;
  sensor.limits.max_range_m = s.sensor.max_range_m;
  body.sensors.push_back(sensor);
  return body;
}

}  // namespace

EstimatorSettings single_vehicle(const PlanarSlamSettings& s,
                                 const std::vector<std::int64_t>& anchor_identities) {
  EstimatorSettings team;
  team.bodies.push_back(body_of(s));
  team.filter.linearization = s.filter.linearization;
  team.filter.map_frame = s.filter.map_frame;
  team.filter.decorrelate = s.filter.decorrelate;
  team.filter.entropy = s.entropy;
  team.association = s.association;
  if (s.association.method == DataAssociationSettings::Method::known)
    team.filter.gate_probability = s.association.gate_probability;
  team.pruning = s.pruning;
  team.health = s.health;
  team.anchors_have_identity = s.association.method == DataAssociationSettings::Method::known;
  if (team.anchors_have_identity && anchor_identities.size() != s.filter.anchors.size())
    throw std::invalid_argument("estimator.anchors_m: with association by identity each anchor needs one");
  for (std::size_t i = 0; i < s.filter.anchors.size(); ++i)
    team.anchors[team.anchors_have_identity ? anchor_identities[i] : static_cast<std::int64_t>(i)] =
        s.filter.anchors[i];
  return team;
}

}  // namespace incognita
