#include "incognita/slam/features/map_management.hpp"

#include <algorithm>

namespace incognita {

void count_frames_away(Estimate& estimate) {
  for (Landmark& landmark : estimate.catalog) ++landmark.frames_away;
  for (const FeatureMatch& match : estimate.matches)
    if (match.outcome == MatchOutcome::matched) estimate.catalog[match.landmark].frames_away = 0;
}

void count_attempts(Estimate& estimate) {
  for (const FeatureMatch& match : estimate.matches) {
    if (match.outcome == MatchOutcome::not_searched || match.outcome == MatchOutcome::unconfirmed) continue;
    Landmark& landmark = estimate.catalog[match.landmark];
    ++landmark.attempts;
    landmark.matches += match.outcome == MatchOutcome::matched;
  }
}

void delete_bad_landmarks(Estimate& estimate, const MapSettings& settings) {
  std::erase_if(estimate.catalog, [&](const Landmark& landmark) {
    if (!landmark.mapped()) return false;
    const bool rarely_matched = landmark.attempts >= settings.min_attempts &&
                                landmark.matches < settings.min_matched_share * landmark.attempts;
    const bool beyond_infinity =
        landmark.kind == Landmark::Kind::inverse_depth && estimate.belief.mean(landmark.block)[5] < 0;
    if (!rarely_matched && !beyond_infinity) return false;
    estimate.belief.drop(landmark.block);
    return true;
  });
}

void simplify_landmarks(Estimate& estimate, const InitializationSettings& settings) {
  const Eigen::Vector3d camera = free_camera::position(estimate.camera_state());
  for (Landmark& landmark : estimate.catalog) {
    if (landmark.kind != Landmark::Kind::inverse_depth) continue;
    const InverseDepthLandmark::State y = estimate.belief.mean(landmark.block);
    const double variance = estimate.belief.covariance(landmark.block)(5, 5);
    if (landmark.initial_axes.linearity_index(y, variance, camera) > settings.max_linearity) continue;
    const auto point = landmark.initial_axes.point(y);
    estimate.belief.replace(landmark.block, PointLandmark::chart, point.position, point.J,
                            Eigen::Matrix3d::Zero());
    landmark.kind = Landmark::Kind::point;
  }
}

}  // namespace incognita
