#include "incognita/slam/features/loop_closure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

constexpr int away_frames = 30;      // without a match, after which a landmark was out of view
constexpr int frames_between = 15;   // failed searches: each takes as long as several frames
constexpr double most_found = 0.25;  // of the returning landmarks: of more, the filter itself closes the loop
// Larger differences are more probably of another place that looks alike
constexpr double most_drift_depths = 0.3, most_turn_rad = 0.3;

bool is_away(const Feature& feature) { return feature.frames_away >= away_frames; }

int returning(const TrackedCamera& camera, MatchOutcome outcome) {
  return static_cast<int>(std::ranges::count_if(camera.matches, [&](const FeatureMatch& match) {
    return match.outcome == outcome && is_away(camera.features.at(match.id));
  }));
}

/// Whether landmarks that should have returned are not where they are expected.
bool misses_landmarks(const TrackedCamera& camera) {
  const int least = camera.settings.relocalization.min_matches;
  const int missed = returning(camera, MatchOutcome::not_found);
  return missed >= least && camera.matched >= least && returning_matches(camera) <= most_found * missed;
}

/// The camera with the landmarks only that were out of view.
TrackedCamera with_landmarks_away(const TrackedCamera& camera) {
  TrackedCamera out{
      .camera = camera.camera, .settings = camera.settings, .index = camera.index, .body = camera.body};
  for (const auto& [id, feature] : camera.features)
    if (is_away(feature)) out.features.emplace(id, feature);
  out.view = camera.view;
  out.sigma_pixel_px = camera.sigma_pixel_px;
  return out;
}

/// Since when the landmarks of this pose were out of view, frames.
int frames_gone(const PoseEvidence& evidence, const TrackedCamera& camera) {
  int least = std::numeric_limits<int>::max();
  for (const FeatureMatch& match : evidence.matches)
    if (match.outcome == MatchOutcome::matched)
      least = std::min(least, camera.features.at(match.id).frames_away);
  return least;
}

/// The transform from where the camera is estimated to that pose. The matches of the pose correct the filter afterwards: an
/// uncertainty this wide adds 1 % to their information.
Drift drift_to(const PoseEvidence& pose, const TrackedCamera& camera) {
  constexpr double prior_sigmas = 10;
  const CameraState& now = camera.view.camera;
  const Eigen::Vector4d before = free_camera::orientation(now), after = free_camera::orientation(pose.camera);
  Drift drift;
  drift.translation = free_camera::position(pose.camera) - free_camera::position(now);
  drift.turn = quaternion_log(quaternion_product<double>(after, quaternion_conjugate(before)));
  PoseCov in_world = PoseCov::Identity();  // its rotation errors are in the axes of the camera
  in_world.bottomRightCorner<3, 3>() = rotation_matrix<double>(after);
  drift.cov.topLeftCorner<6, 6>() = prior_sigmas * prior_sigmas * in_world * pose.cov * in_world.transpose();
  drift.cov(6, 6) = drift.translation.squaredNorm() / std::pow(camera.median_depth_m, 2);
  return drift;
}

bool is_plausible(const Drift& drift, const TrackedCamera& camera) {
  return drift.translation.norm() < most_drift_depths * camera.median_depth_m &&
         drift.turn.norm() < most_turn_rad;
}

/// Landmarks that were seen since then, each with the share of the time that had passed when it was seen last.
std::vector<DriftingLandmark> drifting(const Estimate& estimate, const TrackedCamera& camera, int frames) {
  std::vector<DriftingLandmark> out;
  for (const auto& [id, feature] : camera.features)
    if (feature.frames_away < frames && estimate.landmarks.at(id).mapped())
      out.push_back({id, 1 - static_cast<double>(feature.frames_away) / frames});
  return out;
}

}  // namespace

int returning_matches(const TrackedCamera& camera) { return returning(camera, MatchOutcome::matched); }

std::optional<ClosedLoop> LoopClosure::find(const SummedImage& image, const Estimate& estimate,
                                            const TrackedCamera& camera, double t) {
  if (frames_until_search_ > 0) --frames_until_search_;
  if (frames_until_search_ > 0 || !misses_landmarks(camera)) {
    returning_.restart();
    return std::nullopt;
  }
  const auto found = returning_.find(image, estimate, with_landmarks_away(camera), t);
  if (!returning_.has_candidate()) frames_until_search_ = frames_between;
  if (!found) return std::nullopt;
  ClosedLoop loop;
  loop.drift = drift_to(*found, camera);
  if (!is_plausible(loop.drift, camera)) return std::nullopt;
  loop.landmarks = drifting(estimate, camera, frames_gone(*found, camera));
  return loop;
}

}  // namespace incognita
