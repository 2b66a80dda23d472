// The state of the image front end: the appearance of the landmarks, and what it remembers between frames. What a frame finds
// is found again in the next one: predictions, matches, pyramids.
#include <string>

#include "incognita/slam/features/feature_tracker.hpp"
#include "incognita/slam/features/frame_counter.hpp"
#include "incognita/vision/saved_images.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, PatchPlane& plane) {
  auto& [facing, slope, slope_cov, estimated_from] = plane;
  archive(facing, slope, slope_cov, estimated_from);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, PatchView& view) {
  auto& [texture, coarse, pixel, camera_position, world_from_camera, plane] = view;
  archive(texture, coarse, pixel, camera_position, world_from_camera, plane);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, DescribedView::AtScale& described) {
  auto& [scale, descriptor] = described;
  archive(scale, descriptor);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, DescribedView& view) {
  auto& [camera_position, world_from_camera, pixel, descriptors] = view;
  archive(camera_position, world_from_camera, pixel, descriptors);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Feature& feature) {
  auto& [view, described, depths, attempts, recent_attempts, recent_matches, ray_failures, frames_known,
         frames_away, frames_in_view, frames_out_of_view] = feature;
  archive(view, described, depths, attempts, recent_attempts, recent_matches, ray_failures, frames_known,
          frames_away, frames_in_view, frames_out_of_view);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, TrackedCamera& tracked) {
  auto& [camera, settings, index, body, mount, features, view, guide, matches, ray_matches, ray_particles,
         median_depth_m, max_measurements, predicted, matched, lasting_factor, sigma_pixel_px, lasting] =
      tracked;
  archive(features, median_depth_m, lasting_factor, sigma_pixel_px, lasting);
}

void FrameCounter::state(StateArchive& archive) {
  auto& [image_t, intervals, interval_count, missed] = *this;
  archive(image_t, intervals, interval_count, missed);
}

void LastingErrors::Slot::state(StateArchive& archive) {
  auto& [block_, landmark_, used_, plane_cov_] = *this;
  archive(block_, landmark_, used_, plane_cov_);
}

void LastingErrors::state(StateArchive& archive) {
  auto& [slots, frame] = *this;
  archive(slots, frame);
}

void PixelNoise::Residual::state(StateArchive& archive) {
  auto& [id_, px_] = *this;
  archive(id_, px_);
}

void PixelNoise::state(StateArchive& archive) {
  auto& [squares, now, before, product, square] = *this;
  archive(now, before, product, square);
}

void RollingShutter::Seen::state(StateArchive& archive) {
  auto& [id_, predicted_] = *this;
  archive(id_, predicted_);
}

void RollingShutter::state(StateArchive& archive) {
  auto& [now, before, t_before, information, weighted_sum] = *this;
  archive(now, before, t_before, information, weighted_sum);
}

void Relocalization::Candidate::state(StateArchive& archive) {
  auto& [camera_, cov_, t_, frames_] = *this;
  archive(camera_, cov_, t_, frames_);
}

void Relocalization::state(StateArchive& archive) {
  auto& [random, candidate, frames_until_search] = *this;
  archive(random, candidate, frames_until_search);
}

void LoopClosure::state(StateArchive& archive) {
  auto& [known, frames_until_search] = *this;
  archive(known, frames_until_search);
}

void FeatureTracker::state(StateArchive& archive) {
  auto& [camera, placement, keyframes, moved_estimate, keyframes_are_old, reference_frames, pixel_noise,
         rolling_shutter, relocalization, loop_closure, pyramid, small, small_before, small_rays,
         predicted_rays, before, before_t, sees, has_map, random] = *this;
  archive(camera, keyframes, moved_estimate, keyframes_are_old, reference_frames, pixel_noise,
          rolling_shutter, relocalization, loop_closure, small, small_before, before, before_t, has_map,
          random);
}

}  // namespace incognita
