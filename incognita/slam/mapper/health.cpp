#include "incognita/slam/mapper/health.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/slam/mapper/relative_sigma.hpp"

namespace incognita {
namespace {

/// Rms normalized innovation of the recent updates; 1 is expected.
double innovation_sigmas(const Estimate& e) {
  return e.health.recent_rows > 0 ? std::sqrt(e.health.recent_nis / e.health.recent_rows) : 0;
}

/// Whether a landmark is predicted in view of a point sensor, with a measurement that would correct the filter.
bool is_expected(const Estimate& e, const Landmark& landmark, int which, int sensor,
                 const EstimatorSettings& settings) {
  const auto z = predict_in_view(e, landmark, which, sensor, settings);
  if (!z) return false;
  const auto measurement = linearize_detection(e, which, false, {landmark.id, *z, sensor}, settings);
  return measurement && measurement->is_linear;
}

/// Landmarks are detected by the body's point sensors, none is matched, and enough are predicted in their view.
bool recognizes_nothing(const Estimate& e, int body, const EstimatorSettings& settings) {
  std::set<int> detecting;
  for (const Match& match : e.last.matches)
    if (match.body == body && !match.of_body && !match.image) detecting.insert(match.sensor);
  int expected = 0;
  for (const int sensor : detecting)
    for (const auto& [id, landmark] : e.landmarks)
      expected += is_expected(e, landmark, body, sensor, settings);
  return !detecting.empty() && expected >= settings.health.min_expected;
}

std::string of_numbers(double value, const char* what) {
  std::ostringstream text;
  text.precision(3);
  text << value << what;
  return text.str();
}

/// Counts the ticks that speak against the estimate of a body.
void count(Estimate& e, std::size_t which, int frames, const EstimatorSettings& settings) {
  BodyHealth& health = e.bodies[which].health;
  const int matched = e.bodies[which].counts.matched;
  if (frames > 0)
    health.frames_with_few = matched < settings.health.min_matches ? health.frames_with_few + frames : 0;
  if (matched > 0)
    health.unmatched_ticks = 0;
  else if (recognizes_nothing(e, static_cast<int>(which), settings))
    ++health.unmatched_ticks;
}

/// The reason why the measurements say that a body is lost; empty if they do not.
std::string lost_by_measurements(const Estimate& e, const BodyHealth& health, const HealthSettings& limits) {
  if (health.frames_with_few >= limits.max_ticks)
    return std::to_string(health.frames_with_few) + " frames in a row with fewer than " +
           std::to_string(limits.min_matches) + " features matched";
  if (health.unmatched_ticks >= limits.max_ticks)
    return "no detection matches a landmark, while " + std::to_string(limits.min_expected) +
           " or more are predicted in view, for " + std::to_string(health.unmatched_ticks) + " ticks";
  if (e.health.doubted_ticks < limits.max_ticks) return "";
  return of_numbers(innovation_sigmas(e), " sigma rms are the normalized innovations, expected 1, for ") +
         std::to_string(e.health.doubted_ticks) + " ticks with matches";
}

/// The reason why the estimate of a body is degraded; empty without one.
std::string doubt(const Estimate& e, const BodyHealth& health, const EstimatorSettings& settings) {
  if (health.frames_with_few > 0)
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

/// The reason why the sigma in the world says that a body is lost; empty if it does not.
std::string lost_in_the_world(const Body& body, const HealthSettings& limits) {
  const SmallMatrix& P = body.state_covariance;
  if (!body.pose.position.allFinite() || !body.pose_covariance.allFinite() || !(P.diagonal().minCoeff() >= 0))
    return "pose or covariance is not a number";
  const double sigma = sigma_position(body);
  if (sigma <= limits.max_sigma_position_m) return "";
  return "position sigma " + of_numbers(sigma, " m, limit ") + of_numbers(limits.max_sigma_position_m, " m");
}

/// The same of the sigma relative to what it matched last.
std::string lost_relative_to_map(const Estimate& e, std::size_t which, const EstimatorSettings& settings) {
  constexpr double max_growth_m = 10;
  const Body& body = e.bodies[which];
  if (const auto relative = relative_sigma(e, which, settings)) {
    if (relative->ratio() <= settings.health.max_sigma_ratio) return "";
    return "position sigma " + of_numbers(relative->sigma_m, " m relative to what was matched last, ") +
           of_numbers(relative->distance_m, " m away, limit ") +
           of_numbers(settings.health.max_sigma_ratio, " of the distance");
  }
  const double sigma = sigma_position(body), limit = body.start_sigma_m + max_growth_m;
  if (sigma <= limit) return "";
  return "position sigma " + of_numbers(sigma, " m without a landmark, limit ") + of_numbers(limit, " m");
}

/// The reason why the covariance says that a body is lost; empty if it does not. A match makes it certain of what is around.
std::string lost_by_covariance(const Estimate& e, std::size_t which, const EstimatorSettings& settings) {
  const std::string lost = lost_in_the_world(e.bodies[which], settings.health);
  if (!lost.empty() || e.bodies[which].counts.matched > 0) return lost;
  return lost_relative_to_map(e, which, settings);
}

/// "7 of 12 features matched", for bodies with cameras.
std::string matches_in_words(const MatchCounts& counts) {
  return std::to_string(counts.image_matches) + " of " + std::to_string(counts.searched) +
         " features matched";
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() ? b : b.empty() ? a : a + "; " + b;
}

int badness(TrackingState state) {
  switch (state) {
    case TrackingState::tracking:
      return 0;
    case TrackingState::degraded:
      return 1;
    case TrackingState::relocated:
      return 2;
    case TrackingState::starting:
      return 3;
    case TrackingState::lost:
      return 4;
  }
  return 0;
}

}  // namespace

double sigma_position(const Body& body) {
  const Eigen::Matrix3d cov = body.pose_covariance.topLeftCorner<3, 3>();
  return std::sqrt(std::max(0.0, cov.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
}

bool is_certain(const Estimate& e, std::size_t which, const EstimatorSettings& settings) {
  return lost_in_the_world(e.bodies[which], settings.health).empty() &&
         lost_relative_to_map(e, which, settings).empty();
}

void count_doubted(Estimate& e, const HealthSettings& settings) {
  if (e.last.matched == 0) return;
  e.health.doubted_ticks =
      innovation_sigmas(e) > settings.max_innovation_sigmas ? e.health.doubted_ticks + 1 : 0;
}

TrackingStatus assess(Estimate& e, std::size_t which, int frames, const EstimatorSettings& settings) {
  count(e, which, frames, settings);
  const Body& body = e.bodies[which];
  const std::string seen = frames > 0 ? matches_in_words(body.counts) : "";
  std::string lost = lost_by_covariance(e, which, settings);
  if (lost.empty()) lost = lost_by_measurements(e, body.health, settings.health);
  if (!lost.empty()) return {TrackingState::lost, joined(lost, seen)};
  const std::string reason = doubt(e, body.health, settings);
  return {reason.empty() ? TrackingState::tracking : TrackingState::degraded, joined(reason, seen)};
}

TrackingStatus worst_of(const std::vector<Body>& bodies) {
  const auto is_better = [](const Body& a, const Body& b) {
    return badness(a.status.state) < badness(b.status.state);
  };
  const auto worst = std::max_element(bodies.begin(), bodies.end(), is_better);
  const bool all_alike = std::ranges::all_of(
      bodies, [&](const Body& body) { return body.status.reason == worst->status.reason; });
  TrackingStatus status = worst->status;
  if (bodies.size() > 1 && !status.reason.empty())
    status.reason =
        (all_alike ? "all vehicles: " : "vehicle " + std::to_string(worst - bodies.begin() + 1) + ": ") +
        status.reason;
  return status;
}

}  // namespace incognita
