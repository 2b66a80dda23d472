#include "incognita/slam/mapper/health.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {
namespace {

/// Rms normalized innovation of the recent updates; 1 is expected.
double innovation_sigmas(const Estimate& e) {
  return e.health.recent_rows > 0 ? std::sqrt(e.health.recent_nis / e.health.recent_rows) : 0;
}

/// Number of landmarks and anchors predicted in view of a point sensor.
int landmarks_in_view(const Estimate& e, int which, int sensor_index, const EstimatorSettings& settings) {
  const AnyMotion& motion = settings.bodies[static_cast<std::size_t>(which)].motion;
  const PointSensor& sensor = sensor_of(settings, which, sensor_index);
  const SmallVector state = e.belief.mean(e.bodies[static_cast<std::size_t>(which)].block);
  const SmallVector from = position_of(motion, state, dimensions_of(sensor.sensor)).position;
  int count = 0;
  for (const auto& [id, landmark] : e.landmarks) {
    if (!is_measurable(landmark, sensor.sensor)) continue;
    const SmallVector mean =
        landmark.fixed ? anchor_position(e, landmark.position) : SmallVector(e.belief.mean(landmark.block));
    const auto prediction = predict_measurement(sensor.sensor, motion, state, landmark.form, mean);
    const auto at = position_of(landmark.form, mean);
    count += prediction && at &&
             is_in_view(sensor.sensor, sensor.limits, *prediction, (at->position - from).norm());
  }
  return count;
}

/// Landmarks are detected by point sensors, none is matched, and enough are predicted in their view.
bool recognizes_nothing(const Estimate& e, const EstimatorSettings& settings) {
  if (e.last.matched > 0) return false;
  std::set<std::pair<int, int>> detecting;
  for (const Match& match : e.last.matches)
    if (!match.of_body && !match.image) detecting.emplace(match.body, match.sensor);
  int expected = 0;
  for (const auto& [body, sensor] : detecting) expected += landmarks_in_view(e, body, sensor, settings);
  return !detecting.empty() && expected >= settings.health.min_expected;
}

std::string of_numbers(double value, const char* what) {
  std::ostringstream text;
  text.precision(3);
  text << value << what;
  return text.str();
}

/// Counts the ticks that speak against the estimate.
void count(Estimate& e, int frames, const EstimatorSettings& settings) {
  HealthRecord& record = e.health;
  const HealthSettings& limits = settings.health;
  if (frames > 0)
    record.frames_with_few = e.last.matched < limits.min_matches ? record.frames_with_few + frames : 0;
  if (e.last.matched > 0)
    record.unmatched_ticks = 0;
  else if (recognizes_nothing(e, settings))
    ++record.unmatched_ticks;
  if (e.last.matched > 0)
    record.doubted_ticks = innovation_sigmas(e) > limits.max_innovation_sigmas ? record.doubted_ticks + 1 : 0;
}

/// The reason why the measurements say that the estimate is lost; empty if they do not.
std::string lost_by_measurements(const Estimate& e, const HealthSettings& limits) {
  const HealthRecord& record = e.health;
  if (record.frames_with_few >= limits.max_ticks)
    return std::to_string(record.frames_with_few) + " frames in a row with fewer than " +
           std::to_string(limits.min_matches) + " features matched";
  if (record.unmatched_ticks >= limits.max_ticks)
    return "no detection matches a landmark, while " + std::to_string(limits.min_expected) +
           " or more are predicted in view, for " + std::to_string(record.unmatched_ticks) + " ticks";
  if (record.doubted_ticks < limits.max_ticks) return "";
  return of_numbers(innovation_sigmas(e), " sigma rms are the normalized innovations, expected 1, for ") +
         std::to_string(record.doubted_ticks) + " ticks";
}

/// The reason why the estimate is degraded; empty without one.
std::string doubt(const Estimate& e, const EstimatorSettings& settings) {
  if (e.health.frames_with_few > 0)
    return "fewer than " + std::to_string(settings.health.min_matches) + " features matched";
  if (e.last.refused) return "an update was refused: within rounding it would leave nothing of a variance";
  if (e.last.association_capped)
    return "the joint association reached its cap of " + std::to_string(settings.association.max_nodes) +
           " nodes";
  // NIS above four times its degrees of freedom, and a chance of less than one in a million
  constexpr double chance = 1e-6, most_ratio = 4;
  const int rows = static_cast<int>(std::ceil(e.health.recent_rows));
  if (rows == 0 || e.health.recent_nis < most_ratio * e.health.recent_rows ||
      e.health.recent_nis < chi_square_quantile(1 - chance, rows))
    return "";
  return of_numbers(
      innovation_sigmas(e),
      " sigma rms are the normalized innovations, expected 1: noises or initial depths do not fit");
}

/// The reason why the covariance says that a body is lost; empty if it does not.
std::string lost_by_covariance(const Body& body, const HealthSettings& limits) {
  const SmallMatrix& P = body.state_covariance;
  if (!body.pose.position.allFinite() || !body.pose_covariance.allFinite() || !(P.diagonal().minCoeff() >= 0))
    return "pose or covariance is not a number";
  const double sigma = sigma_position(body);
  if (sigma <= limits.max_sigma_position_m) return "";
  return "position sigma " + of_numbers(sigma, " m, limit ") + of_numbers(limits.max_sigma_position_m, " m");
}

/// "7 of 12 features matched", for bodies with cameras.
std::string matches_in_words(const Estimate& e) {
  return std::to_string(e.last.image_matches) + " of " + std::to_string(e.last.predicted) +
         " features matched";
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() ? b : b.empty() ? a : a + "; " + b;
}

}  // namespace

double sigma_position(const Body& body) {
  const Eigen::Matrix3d cov = body.pose_covariance.topLeftCorner<3, 3>();
  return std::sqrt(std::max(0.0, cov.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
}

TrackingStatus assess(Estimate& e, int frames, const EstimatorSettings& settings) {
  const std::string seen = frames > 0 ? matches_in_words(e) : "";
  count(e, frames, settings);
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    const std::string lost = lost_by_covariance(e.bodies[i], settings.health);
    if (lost.empty()) continue;
    const std::string which = e.bodies.size() > 1 ? "vehicle " + std::to_string(i + 1) + ": " : "";
    return {TrackingState::lost, joined(which + lost, seen)};
  }
  if (const std::string lost = lost_by_measurements(e, settings.health); !lost.empty())
    return {TrackingState::lost, joined(lost, seen)};
  const std::string reason = doubt(e, settings);
  return {reason.empty() ? TrackingState::tracking : TrackingState::degraded, joined(reason, seen)};
}

}  // namespace incognita
