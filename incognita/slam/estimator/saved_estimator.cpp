// The state of the estimator, without that of the estimate.
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, TargetPose& target) {
  auto& [position, world_from_camera, covariance, pixels, rms_px, second_rms_px] = target;
  archive(position, world_from_camera, covariance, pixels, rms_px, second_rms_px);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, FeatureTracker::Start& start) {
  auto& [ready, given_up, pose, reason] = start;
  archive(ready, given_up, pose, reason);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, PositionReading& reading) {
  auto& [t, position] = reading;
  archive(t, position);
}

void EstimatorStart::state(StateArchive& archive) {
  auto& [starts, first_fixes] = *this;
  archive(starts, first_fixes);
}

void SlamEstimator::TrackedBody::state(StateArchive& archive) {
  auto& [frames_, missed_, was_lost_, matched_few_] = *this;
  archive(frames_, missed_, was_lost_, matched_few_);
}

void SlamEstimator::state(StateArchive& archive) {
  auto& [settings, cameras, frame_counters, start, bodies, inliers, pruning, depth_lines, entropy, in_images,
         measurements] = *this;
  archive.each(cameras, "cameras");
  archive.each(frame_counters, "cameras");
  archive.each(bodies, "bodies");
  archive(start, pruning, depth_lines, entropy);
}

}  // namespace incognita
