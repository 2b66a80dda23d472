// The state of the keyframes.
#include <string>

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/bundle/keyframes.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, BundleView& view) {
  auto& [position, world_from_camera, fixed] = view;
  archive(position, world_from_camera, fixed);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, BundlePoint& point) {
  auto& [kind, value, initial_axes, host, prior_inverse_depth, sigma_prior_inverse_depth] = point;
  archive(kind, value, initial_axes, host, prior_inverse_depth, sigma_prior_inverse_depth);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, BundleObservation& observation) {
  auto& [view, point, pixel, cov] = observation;
  archive(view, point, pixel, cov);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Bundle& bundle) {
  auto& [views, points, observations, first_view, first_view_cov] = bundle;
  archive(views, points, observations, first_view, first_view_cov);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, DepthPrior& prior) {
  auto& [mean, sigma] = prior;
  archive(mean, sigma);
}

void Keyframes::Seen::state(StateArchive& archive) {
  auto& [view_, pixel_, cov_] = *this;
  archive(view_, pixel_, cov_);
}

void Keyframes::Track::state(StateArchive& archive) {
  auto& [seen_, prior_, point_, is_reference_] = *this;
  archive(seen_, prior_, point_, is_reference_);
}

/// The equations are made anew by each adjustment.
void Keyframes::state(StateArchive& archive) {
  auto& [views, times, tracks, first_view, first_view_cov, frames, t, t_before, bundle, numbers, indices, ids,
         cost, window, begins, equations] = *this;
  archive(views, times, tracks, first_view, first_view_cov, frames, t, t_before, bundle, numbers, indices,
          ids, cost, window, begins);
  if (!archive.restores()) return;
  for (const auto& [id, track] : tracks) {
    if (track.seen.empty()) throw DamagedState("landmark " + std::to_string(id) + " was seen in no keyframe");
    for (const Seen& seen : track.seen)
      if (!views.contains(seen.view))
        throw DamagedState("keyframe " + std::to_string(seen.view) + " is missing");
  }
}

}  // namespace incognita
