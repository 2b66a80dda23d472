// The state of the analyses that accompany a run.
#include "incognita/app/loop/association_score.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, PlanarScene::Landmark& landmark) {
  auto& [id, first, position] = landmark;
  archive(id, first, position);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, PlanarScene& scene) {
  auto& [vehicles, landmarks, errors] = scene;
  archive(vehicles, landmarks, errors);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, InverseDepthLandmark& form) {
  auto& [world_from_initial_camera] = form;
  archive(world_from_initial_camera);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, SpatialScene::Landmark& landmark) {
  auto& [id, first, form, initial_axes, mean] = landmark;
  archive(id, first, form, initial_axes, mean);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, SpatialScene& scene) {
  auto& [camera, landmarks, errors] = scene;
  archive(camera, landmarks, errors);
}

namespace {

void monitor_state(StateArchive& archive, std::optional<ObservabilityMonitor>& monitor) {
  bool runs = monitor.has_value();
  archive(runs);
  if (archive.restores()) {
    monitor.reset();
    if (runs) monitor.emplace(std::vector<ObservabilityMonitor::Vehicle>{});
  }
  if (monitor) archive(*monitor);
}

}  // namespace

void ObservabilityWatch::state(StateArchive& archive) {
  auto& [monitor, measurement_monitor, anchors, fixes, scene, too_large, finite] = *this;
  monitor_state(archive, monitor);
  monitor_state(archive, measurement_monitor);
  archive(anchors, fixes, scene, too_large, finite);
}

void AssociationScore::state(StateArchive& archive) {
  auto& [truth, landmark_of, right, wrong, missed, duplicate_landmarks] = *this;
  archive(landmark_of, right, wrong, missed, duplicate_landmarks);
}

}  // namespace incognita
