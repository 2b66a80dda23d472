#include "incognita/slam/features/map_management.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/loop_closure.hpp"
#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

using Kind = LandmarkParametrization::Kind;

bool is_inverse_depth(const Landmark& landmark) {
  return !landmark.fixed && landmark.form.kind == Kind::inverse_depth;
}

void count_attempt(Feature& feature, bool matched, int memory_attempts) {
  ++feature.attempts;
  if (memory_attempts == 0) return;
  const double kept = 1 - 1.0 / memory_attempts;
  feature.recent_attempts = kept * feature.recent_attempts + 1;
  feature.recent_matches = kept * feature.recent_matches + matched;
}

bool is_rarely_matched(const Landmark& landmark, const Feature& feature, const MapSettings& settings) {
  if (feature.attempts < settings.min_attempts) return false;
  if (settings.memory_attempts == 0)
    return landmark.detection_count < settings.min_matched_share * feature.attempts;
  return feature.recent_matches < settings.min_matched_share * feature.recent_attempts;
}

}  // namespace

double match_probability(const Feature& feature) {
  return (feature.recent_matches + 1) / (feature.recent_attempts + 1);
}

double expected_matches(const TrackedCamera& camera) {
  double sum = 0;
  for (const FeatureMatch& match : camera.matches) sum += match_probability(camera.features.at(match.id));
  return sum;
}

void count_frames(TrackedCamera& camera) {
  for (auto& [id, feature] : camera.features) {
    ++feature.frames_known;
    ++feature.frames_away;
    ++feature.frames_out_of_view;
  }
  for (const FeatureMatch& match : camera.matches) {
    Feature& feature = camera.features.at(match.id);
    feature.frames_in_view = feature.frames_out_of_view > 1 ? 1 : feature.frames_in_view + 1;
    feature.frames_out_of_view = 0;
    if (match.outcome == MatchOutcome::matched) feature.frames_away = 0;
  }
}

void count_attempts(Estimate& estimate, TrackedCamera& camera) {
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome == MatchOutcome::not_searched || match.outcome == MatchOutcome::unconfirmed) continue;
    const bool matched = match.outcome == MatchOutcome::matched;
    count_attempt(camera.features.at(match.id), matched, camera.settings.map.memory_attempts);
    estimate.landmarks.at(match.id).detection_count += matched;
  }
}

void delete_bad_landmarks(Estimate& estimate, TrackedCamera& camera) {
  const MapSettings& settings = camera.settings.map;
  const MissedLandmarks missed = missed_landmarks(camera);
  for_each_feature(estimate, camera.features, [&](const Landmark& landmark, const Feature& feature) {
    if (!landmark.mapped()) return;
    const bool beyond_infinity = is_inverse_depth(landmark) && estimate.belief.mean(landmark.block)[5] < 0;
    if ((is_rarely_matched(landmark, feature, settings) && !missed.may_be_right(landmark.id)) ||
        beyond_infinity)
      remove_landmark(estimate, camera, landmark.id);
  });
}

int delete_least_matched(Estimate& estimate, TrackedCamera& camera, int count) {
  std::vector<std::pair<int, std::int64_t>> candidates;  // number of matches, id
  std::set<std::int64_t> in_view;
  for (const FeatureMatch& match : camera.matches) in_view.insert(match.id);
  for_each_feature(estimate, camera.features, [&](const Landmark& landmark, const Feature&) {
    if (landmark.mapped() && !in_view.contains(landmark.id))
      candidates.emplace_back(landmark.detection_count, landmark.id);
  });
  const auto deleted = std::min(candidates.size(), static_cast<std::size_t>(std::max(0, count)));
  std::ranges::partial_sort(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(deleted));
  for (std::size_t i = 0; i < deleted; ++i) remove_landmark(estimate, camera, candidates[i].second);
  return static_cast<int>(deleted);
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
