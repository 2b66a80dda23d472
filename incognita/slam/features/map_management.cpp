#include "incognita/slam/features/map_management.hpp"

#include <algorithm>

namespace incognita {

void count_frames_away(Estimate& estimate) {
  for (Landmark& landmark : estimate.catalogue) ++landmark.frames_away;
  for (const Look& look : estimate.looks)
    if (look.outcome == LookOutcome::matched) estimate.catalogue[look.landmark].frames_away = 0;
}

void count_attempts(Estimate& estimate) {
  for (const Look& look : estimate.looks) {
    if (look.outcome == LookOutcome::not_tried || look.outcome == LookOutcome::alone) continue;
    Landmark& landmark = estimate.catalogue[look.landmark];
    ++landmark.attempts;
    landmark.matches += look.outcome == LookOutcome::matched;
  }
}

void delete_bad_landmarks(Estimate& estimate, const MapSettings& settings) {
  std::erase_if(estimate.catalogue, [&](const Landmark& landmark) {
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

void simplify_landmarks(Estimate& estimate, const BirthSettings& settings) {
  const Eigen::Vector3d camera = free_camera::position(estimate.camera_state());
  for (Landmark& landmark : estimate.catalogue) {
    if (landmark.kind != Landmark::Kind::inverse_depth) continue;
    const InverseDepthLandmark::State y = estimate.belief.mean(landmark.block);
    const double variance = estimate.belief.covariance(landmark.block)(5, 5);
    if (landmark.birth_axes.linearity_index(y, variance, camera) > settings.max_linearity) continue;
    const auto point = landmark.birth_axes.point(y);
    estimate.belief.replace(landmark.block, PointLandmark::chart, point.position, point.J,
                            Eigen::Matrix3d::Zero());
    landmark.kind = Landmark::Kind::point;
  }
}

}  // namespace incognita
