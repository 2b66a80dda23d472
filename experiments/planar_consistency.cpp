#include "experiments/planar_consistency.hpp"

#include <cmath>
#include <numeric>

#include "experiments/run_trace.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"

namespace incognita {
namespace {

PlanarSlamSettings settings_for(const PlanarLoopSettings& drive, const PlanarFilterSettings& filter) {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.vehicle.sigma_speed_m_s = drive.sigma_speed_m_s;
  s.vehicle.sigma_turn_rate_rad_s = drive.sigma_turn_rate_rad_s;
  s.sensor.sigma_range_m = drive.sigma_range_m;
  s.sensor.sigma_bearing_rad = drive.sigma_bearing_rad;
  s.filter = filter;
  s.filter.sigma_fix_m = drive.sigma_fix_m;
  s.association.method = DataAssociationSettings::Method::known;
  s.association.gate_probability = 1 - 1e-12;  // of known identity: nothing is refused
  s.health.max_sigma_position_m = 1e6;
  return s;
}

}  // namespace

std::vector<PlanarFilterChoice> planar_filter_choices() {
  std::vector<PlanarFilterChoice> choices;
  const auto add = [&](const char* name, Linearization linearization, MapFrame frame) {
    PlanarFilterSettings filter;
    filter.linearization = linearization;
    filter.map_frame = frame;
    choices.push_back({name, filter});
  };
  add("EKF", Linearization::analytic, MapFrame::world);
  add("iterated EKF", Linearization::iterated, MapFrame::world);
  add("unscented vehicle", Linearization::unscented_vehicle, MapFrame::world);
  add("first-estimate Jacobians", Linearization::first_estimate, MapFrame::world);
  add("map in the vehicle's frame", Linearization::analytic, MapFrame::vehicle);
  return choices;
}

StandingVehicle standing_vehicle(std::uint64_t seed, Linearization linearization) {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.sensor = {0.1, 0, radians(1), 80};
  s.filter.linearization = linearization;
  s.association.method = DataAssociationSettings::Method::known;
  s.association.gate_probability = 1 - 1e-12;
  s.start.sigma_heading_rad = radians(standing_sigma_heading_deg);
  SlamEstimator estimator(single_vehicle(s));
  RandomStream random(seed, "standing vehicle");
  const planar::Pose<double> truth(0, 0, s.start.sigma_heading_rad * random.normal());
  const Eigen::Vector2d landmark(10, 0);
  Estimate estimate;
  for (int k = 0; k < standing_measurements; ++k) {
    Eigen::Vector2d z = RangeBearing::h<double>(truth, landmark);
    z[0] += s.sensor.sigma_range_m * random.normal();
    z[1] += s.sensor.sigma_bearing_rad * random.normal();
    Observation observation;
    observation.bodies.resize(1);
    observation.bodies[0].landmarks = {{0, z}};
    estimator.update(estimate, {}, observation, {k, static_cast<double>(k), k > 0 ? 1.0 : 0.0});
  }
  const Body& at = estimate.bodies.front();
  return {degrees(std::sqrt(at.state_covariance(2, 2))),
          std::pow(wrap_angle(truth[2] - at.state[2]), 2) / at.state_covariance(2, 2)};
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
