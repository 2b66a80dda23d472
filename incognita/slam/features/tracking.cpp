#include "incognita/slam/features/tracking.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

namespace incognita {
namespace {

std::string of_matched(int matched, int searched, double gate_sigmas) {
  char text[96];
  std::snprintf(text, sizeof text, "%d of %d features matched, gate %g sigma", matched, searched,
                gate_sigmas);
  return text;
}

}  // namespace

TrackingStatus assess(const TrackingStatus& before, int matched, int searched, double sigma_position_m,
                      const CameraSlamSettings& settings) {
  TrackingStatus now;
  const LostSettings& lost = settings.lost;
  now.reason = of_matched(matched, searched, settings.search.gate_sigmas);
  now.frames_with_few = matched < lost.min_matches ? before.frames_with_few + 1 : 0;
  if (!(sigma_position_m <= lost.max_sigma_position_m)) {
    now.state = TrackingState::lost;
    char text[96];
    std::snprintf(text, sizeof text, "position sigma %.3g m, limit %g m; ", sigma_position_m,
                  lost.max_sigma_position_m);
    now.reason = text + now.reason;
  } else if (now.frames_with_few >= lost.max_frames) {
    now.state = TrackingState::lost;
    now.reason += "; " + std::to_string(now.frames_with_few) + " frames in a row with fewer than " +
                  std::to_string(lost.min_matches);
  } else {
    now.state = now.frames_with_few > 0 ? TrackingState::degraded : TrackingState::tracking;
  }
  return now;
}

double sigma_position(const Estimate& estimate) {
  const Eigen::Matrix3d cov = estimate.belief.covariance(estimate.camera).topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(cov, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

}  // namespace incognita
