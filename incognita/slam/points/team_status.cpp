#include "incognita/slam/points/team_status.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/points/team_measurements.hpp"

namespace incognita {
namespace {

/// Rms normalized innovation of the recent updates; 1 is expected.
double innovation_sigmas(const TeamEstimate& e) {
  return e.recent_rows > 0 ? std::sqrt(e.recent_nis / e.recent_rows) : 0;
}

/// Number of landmarks and anchors predicted in view of a vehicle.
int landmarks_in_view(const TeamEstimate& e, std::size_t vehicle, const TeamSettings& settings) {
  const TeamMember& member = settings.members[vehicle];
  const SmallVector state = e.belief.mean(e.vehicles[vehicle].block);
  const SmallVector from = position_of(member.motion, state, dimensions_of(member.sensor)).position;
  int count = 0;
  const auto add = [&](const LandmarkParametrization& form, const SmallVector& landmark) {
    const auto prediction = predict_measurement(member.sensor, member.motion, state, form, landmark);
    const auto at = position_of(form, landmark);
    count += prediction && at &&
             is_in_view(member.sensor, member.reach, *prediction, (at->position - from).norm());
  };
  for (const auto& [identity, anchor] : e.anchors) add({}, anchor_position(e, anchor.position));
  for (const auto& [identity, landmark] : e.landmarks) add(landmark.form, e.belief.mean(landmark.block));
  return count;
}

bool detects(const TeamEstimate& e, std::size_t vehicle) {
  return std::any_of(e.matches.begin(), e.matches.end(), [&](const Match& match) {
    return match.vehicle == static_cast<int>(vehicle) && !match.of_vehicle;
  });
}

/// Landmarks are detected, none is matched, and enough are predicted in view.
bool recognizes_nothing(const TeamEstimate& e, const TeamSettings& settings) {
  if (e.matched > 0) return false;
  int expected = 0;
  for (std::size_t i = 0; i < e.vehicles.size(); ++i)
    if (detects(e, i)) expected += landmarks_in_view(e, i, settings);
  return expected >= settings.lost.min_expected;
}

std::string of_numbers(double value, const char* what) {
  std::ostringstream text;
  text.precision(3);
  text << value << what;
  return text.str();
}

/// The reason why the measurements say that the estimate is lost; empty if they do not.
std::string lost_by_measurements(TeamEstimate& e, const TeamSettings& settings) {
  const TeamLostSettings& lost = settings.lost;
  if (e.matched > 0)
    e.unmatched_ticks = 0;
  else if (recognizes_nothing(e, settings))
    ++e.unmatched_ticks;
  e.doubted_ticks = innovation_sigmas(e) > lost.max_innovation_sigmas ? e.doubted_ticks + 1 : 0;
  if (e.unmatched_ticks >= lost.max_ticks)
    return "no detection matches a landmark, while " + std::to_string(lost.min_expected) +
           " or more are predicted in view, for " + std::to_string(e.unmatched_ticks) + " ticks";
  if (e.doubted_ticks < lost.max_ticks) return "";
  return of_numbers(innovation_sigmas(e), " sigma rms are the normalized innovations, expected 1, for ") +
         std::to_string(e.doubted_ticks) + " ticks";
}

/// The reason why the estimate is degraded; empty without one.
std::string doubt(const TeamEstimate& e, const TeamSettings& settings) {
  if (e.refused) return "an update was refused: within rounding it would leave nothing of a variance";
  if (e.association_capped)
    return "the joint association reached its cap of " + std::to_string(settings.association.max_nodes) +
           " nodes";
  // NIS above four times its degrees of freedom, and a chance of less than one in a million
  constexpr double chance = 1e-6, most_ratio = 4;
  const int rows = static_cast<int>(std::ceil(e.recent_rows));
  if (rows == 0 || e.recent_nis < most_ratio * e.recent_rows ||
      e.recent_nis < chi_square_quantile(1 - chance, rows))
    return "";
  return of_numbers(
      innovation_sigmas(e),
      " sigma rms are the normalized innovations, expected 1: noises or initial depths do not fit");
}

/// The reason why the covariance says that a vehicle is lost; empty if it does not.
std::string lost_by_covariance(const TeamVehicle& vehicle, const TeamLostSettings& lost) {
  const SmallMatrix& P = vehicle.state_covariance;
  if (!vehicle.pose.position.allFinite() || !vehicle.pose_covariance.allFinite() ||
      !(P.diagonal().minCoeff() >= 0))
    return "pose or covariance is not a number";
  const Eigen::Matrix3d position_cov = vehicle.pose_covariance.topLeftCorner<3, 3>();
  const double sigma =
      std::sqrt(std::max(0.0, position_cov.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
  if (sigma <= lost.max_sigma_position_m) return "";
  return "position sigma " + std::to_string(sigma) + " m, the limit is " +
         std::to_string(lost.max_sigma_position_m);
}

}  // namespace

TrackingStatus assess(TeamEstimate& e, const TeamSettings& settings) {
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    const std::string lost = lost_by_covariance(e.vehicles[i], settings.lost);
    if (lost.empty()) continue;
    return {TrackingState::lost,
            (e.vehicles.size() > 1 ? "vehicle " + std::to_string(i + 1) + ": " : "") + lost, 0};
  }
  if (const std::string lost = lost_by_measurements(e, settings); !lost.empty())
    return {TrackingState::lost, lost, 0};
  const std::string reason = doubt(e, settings);
  return {reason.empty() ? TrackingState::tracking : TrackingState::degraded, reason, 0};
}

}  // namespace incognita
