#include "incognita/slam/features/map_management.hpp"

#include <algorithm>

#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

using Kind = LandmarkParametrization::Kind;

bool is_inverse_depth(const Landmark& landmark) {
  return !landmark.fixed && landmark.form.kind == Kind::inverse_depth;
}

}  // namespace

void count_frames_away(TrackedCamera& camera) {
  for (auto& [id, feature] : camera.features) ++feature.frames_away;
  for (const FeatureMatch& match : camera.matches)
    if (match.outcome == MatchOutcome::matched) camera.features.at(match.id).frames_away = 0;
}

void count_attempts(Estimate& estimate, TrackedCamera& camera) {
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome == MatchOutcome::not_searched || match.outcome == MatchOutcome::unconfirmed) continue;
    ++camera.features.at(match.id).attempts;
    estimate.landmarks.at(match.id).detection_count += match.outcome == MatchOutcome::matched;
  }
}

void delete_bad_landmarks(Estimate& estimate, TrackedCamera& camera) {
  const MapSettings& settings = camera.settings.map;
  for_each_feature(estimate, camera.features, [&](const Landmark& landmark, const Feature& feature) {
    if (!landmark.mapped()) return;
    const bool rarely_matched = feature.attempts >= settings.min_attempts &&
                                landmark.detection_count < settings.min_matched_share * feature.attempts;
    const bool beyond_infinity = is_inverse_depth(landmark) && estimate.belief.mean(landmark.block)[5] < 0;
    if (rarely_matched || beyond_infinity) remove_landmark(estimate, camera, landmark.id);
  });
}

void simplify_landmarks(Estimate& estimate, const TrackedCamera& camera) {
  const Eigen::Vector3d from = free_camera::position(camera.view.camera);
  for_each_feature(estimate, camera.features, [&](Landmark& landmark, const Feature&) {
    if (!is_inverse_depth(landmark)) return;
    const InverseDepthLandmark axes{landmark.form.initial_axes};
    const InverseDepthLandmark::State y = estimate.belief.mean(landmark.block);
    const double variance = estimate.belief.covariance(landmark.block)(5, 5);
    if (axes.linearity_index(y, variance, from) > camera.settings.initialization.max_linearity) return;
    const auto point = axes.point(y);
    convert_to_point(estimate.belief, landmark, point.position, point.J, SmallMatrix::Zero(3, 3));
  });
}

void remove_landmark(Estimate& estimate, TrackedCamera& camera, std::int64_t id) {
  remove_landmark(estimate, id);
  camera.features.erase(id);
}

}  // namespace incognita
