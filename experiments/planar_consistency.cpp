#include "experiments/planar_consistency.hpp"

#include <cmath>
#include <numeric>

#include "experiments/run_trace.hpp"
#include "incognita/analysis/evaluation/map_error.hpp"
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

LandmarksAtOnce landmarks_of(const Estimate& estimate, const std::vector<RangeRecording::Landmark>& truth) {
  double error2 = 0, variance = 0, count = 0;
  for (const auto& [id, landmark] : estimate.landmarks) {
    if (landmark.fixed) continue;
    const LandmarkPosition at = *position_of(landmark, estimate);
    error2 += (at.position - truth[static_cast<std::size_t>(id)].position).squaredNorm();
    variance += at.covariance.trace(), ++count;
  }
  return {std::sqrt(error2 / count), std::sqrt(variance / count)};
}

double fitted_position_rms(const RunTrace& trace) {
  std::vector<Eigen::Vector2d> path, truth;
  for (const PoseInstant& i : trace.instants)
    path.push_back(i.mean.head<2>()), truth.push_back(i.truth.head<2>());
  const PlanarFit fit = fit_rigid(path, truth);
  double sum = 0;
  for (std::size_t i = 0; i < path.size(); ++i) sum += (fit(path[i]) - truth[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(path.size()));
}

double position_sigma(const RunTrace& trace) {
  double sum = 0;
  for (const PoseInstant& i : trace.instants) sum += i.covariance.topLeftCorner<2, 2>().trace();
  return std::sqrt(sum / static_cast<double>(trace.instants.size()));
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

StandingVehicle standing_vehicle(std::uint64_t seed, Linearization linearization, int measurements) {
  RandomStream random(seed, "standing vehicle");
  const double heading = -radians(standing_sigma_heading_deg) * random.normal();
  return standing_vehicle(
      {.linearization = linearization, .first_estimate = {0, 0, heading}, .measurements = measurements},
      random);
}

PlanarConsistency planar_consistency(const PlanarLoopSettings& drive, std::uint64_t seed,
                                     const PlanarFilterSettings& filter, double sigma_first_heading_rad) {
  const auto recordings =
      std::make_shared<const std::vector<RangeRecording>>(1, drive_planar_loop(drive, seed));
  const RangeRecording& recording = recordings->front();
  PlanarSlamSettings settings = settings_for(drive, filter);
  settings.start.sigma_heading_rad = sigma_first_heading_rad;
  settings.start.heading_rad = sigma_first_heading_rad * RandomStream(seed, "first heading").normal();
  RunTrace trace;
  PlanarConsistency result;
  double updates = 0;
  bool half = false;
  const auto gather = [&](const Estimate& estimate, const Tick& tick) {
    if (estimate.last.update.rows > 0)
      result.nis += estimate.last.update.nis / estimate.last.update.rows, ++updates;
    if (!half && 2 * tick.t >= drive.duration_s)
      result.at_half = landmarks_of(estimate, recording.landmarks), half = true;
    if (tick.frame == 0) return;  // the start is known exactly, or its first heading was drawn
    const auto truth = true_position(recording, tick.t);
    const Body& at = estimate.bodies.front();
    trace.add(
        tick.t,
        {{truth->position.x(), truth->position.y(), *truth->heading_rad}, at.state, at.state_covariance});
  };
  std::vector<std::int64_t> anchors(filter.anchors.size());
  std::iota(anchors.begin(), anchors.end(), 0);  // the drive identifies its landmarks by their order
  const Estimate last = replay(recordings, drive.duration_s,
                               {drive.max_range_m * 2, filter.use_fixes ? Fixes::all : Fixes::none},
                               single_vehicle(settings, anchors), gather);
  result.nees = trace.mean_nees(), result.nis /= updates;
  result.position_rms_m = trace.position_rms_m(), result.heading_rms_rad = trace.heading_rms_rad();
  result.fitted_position_rms_m = fitted_position_rms(trace);
  result.position_sigma_m = position_sigma(trace);
  result.at_end = landmarks_of(last, recording.landmarks);
  return result;
}

}  // namespace incognita
