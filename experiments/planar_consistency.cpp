#include "experiments/planar_consistency.hpp"

#include <cmath>
#include <numeric>

#include "experiments/run_trace.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"

namespace incognita {
namespace {

/// Identities are known, and nothing is refused.
PlanarSlamSettings with_known_identities(const PlanarFilterSettings& filter) {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.filter = filter;
  s.association.method = DataAssociationSettings::Method::known;
  s.association.gate_probability = 1 - 1e-12;
  s.health.max_sigma_position_m = 1e6;
  return s;
}

PlanarFilterSettings with(Linearization linearization) {
  PlanarFilterSettings filter;
  filter.linearization = linearization;
  return filter;
}

PlanarSlamSettings settings_for(const PlanarLoopSettings& drive, const PlanarFilterSettings& filter) {
  PlanarSlamSettings s = with_known_identities(filter);
  s.vehicle.sigma_speed_m_s = drive.sigma_speed_m_s;
  s.vehicle.sigma_turn_rate_rad_s = drive.sigma_turn_rate_rad_s;
  s.sensor.sigma_range_m = drive.sigma_range_m;
  s.sensor.sigma_bearing_rad = drive.sigma_bearing_rad;
  s.filter.sigma_fix_m = drive.sigma_fix_m;
  return s;
}

}  // namespace

std::vector<PlanarFilterChoice> planar_filter_choices() {
  PlanarFilterSettings in_vehicle_frame;
  in_vehicle_frame.map_frame = MapFrame::vehicle;
  return {{"EKF", {}},
          {"iterated EKF", with(Linearization::iterated)},
          {"unscented vehicle", with(Linearization::unscented_vehicle)},
          {"first-estimate Jacobians", with(Linearization::first_estimate)},
          {"map in the vehicle's frame", in_vehicle_frame}};
}

StandingVehicle standing_vehicle(const StandingSettings& settings, RandomStream& random) {
  PlanarSlamSettings s = with_known_identities(with(settings.linearization));
  s.sensor = {0.1, 0, radians(settings.sigma_bearing_deg), 80};
  s.start.position_m = settings.first_estimate.head<2>();
  s.start.heading_rad = settings.first_estimate[2];
  s.start.sigma_position_m = settings.sigma_position_m;
  s.start.sigma_heading_rad = radians(settings.sigma_heading_deg);
  SlamEstimator estimator(single_vehicle(s));
  Estimate estimate;
  for (int k = 0; k < settings.measurements; ++k) {
    Eigen::Vector2d z(10, 0);
    z[0] += s.sensor.sigma_range_m * random.normal();
    z[1] += s.sensor.sigma_bearing_rad * random.normal();
    Observation observation;
    observation.bodies.resize(1);
    observation.bodies[0].landmarks = {{0, z}};
    estimator.update(estimate, {}, observation, {k, static_cast<double>(k), k > 0 ? 1.0 : 0.0});
  }
  const Body& at = estimate.bodies.front();
  const double variance = at.state_covariance(2, 2);
  return {degrees(std::sqrt(variance)), std::pow(wrap_angle(at.state[2]), 2) / variance};
}

StandingVehicle standing_vehicle(std::uint64_t seed, Linearization linearization) {
  RandomStream random(seed, "standing vehicle");
  const double heading = -radians(standing_sigma_heading_deg) * random.normal();
  return standing_vehicle({.linearization = linearization, .first_estimate = {0, 0, heading}}, random);
}

PlanarConsistency planar_consistency(const PlanarLoopSettings& drive, std::uint64_t seed,
                                     const PlanarFilterSettings& filter) {
  const auto recordings =
      std::make_shared<const std::vector<RangeRecording>>(1, drive_planar_loop(drive, seed));
  RunTrace trace;
  double nis = 0, updates = 0;
  const auto gather = [&](const Estimate& estimate, const Tick& tick) {
    if (estimate.last.update.rows > 0) nis += estimate.last.update.nis / estimate.last.update.rows, ++updates;
    if (tick.frame == 0) return;  // the start is known exactly
    const auto truth = true_position(recordings->front(), tick.t);
    const Body& at = estimate.bodies.front();
    trace.add(
        tick.t,
        {{truth->position.x(), truth->position.y(), *truth->heading_rad}, at.state, at.state_covariance});
  };
  std::vector<std::int64_t> anchors(filter.anchors.size());
  std::iota(anchors.begin(), anchors.end(), 0);  // the drive identifies its landmarks by their order
  replay(recordings, drive.duration_s, {drive.max_range_m * 2, filter.use_fixes ? Fixes::all : Fixes::none},
         single_vehicle(settings_for(drive, filter), anchors), gather);
  return {trace.mean_nees(), nis / updates, trace.position_rms_m(), trace.heading_rms_rad()};
}

}  // namespace incognita
