#include "incognita/app/loop/room_map_truth.hpp"

#include <utility>

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {

RoomMapTruth::RoomMapTruth(SeenSurface seen, SurfacePatches patches)
    : seen_(std::move(seen)), patches_(std::move(patches)), mapped_(patches_.areas_m2()) {}

RoomMapTruth::TruePoint RoomMapTruth::true_point(const std::optional<Eigen::Vector3d>& position) const {
  return {position, position ? patches_.patch_at(*position) : std::nullopt};
}

/// Adds the landmarks that began in this frame and removes those that are gone. Both lists are in the order of the ids.
void RoomMapTruth::follow(const std::optional<Truth>& truth, const Estimator& estimator, const Tick& tick) {
  const auto* const slam = dynamic_cast<const SlamEstimator*>(&estimator);
  if (!slam || slam->cameras().empty()) return;
  const TrackedCamera& camera = slam->cameras().front().camera();
  auto known = points_.begin();
  for (const auto& [id, feature] : camera.features) {
    while (known != points_.end() && known->first < id) known = points_.erase(known);
    if (known != points_.end() && known->first == id) {
      ++known;
      continue;
    }
    const bool is_new = feature.frames_known == 0 && truth && camera.body < truth->bodies.size();
    const auto position =
        is_new ? seen_.at(feature.view.pixel, truth->bodies[camera.body], tick) : std::nullopt;
    points_.emplace_hint(known, id, true_point(position));
  }
  points_.erase(known, points_.end());
}

void RoomMapTruth::put(const std::optional<Truth>& truth, const Estimator& estimator, Snapshot& snapshot) {
  follow(truth, estimator, snapshot.tick);
  mapped_.restart();
  auto known =
      points_.begin();  // the landmarks of a snapshot are in the order of their ids, after the anchors
  for (SnapshotLandmark& landmark : snapshot.landmarks) {
    if (landmark.anchor) continue;
    while (known != points_.end() && known->first < landmark.id) ++known;
    if (known == points_.end()) break;
    if (known->first != landmark.id || !known->second.position) continue;
    landmark.truth = known->second.position;
    mapped_.add(known->second.patch, *landmark.truth, landmark.position);
  }
  snapshot.mapped = mapped_.share();
}

void RoomMapTruth::state(StateArchive& archive) {
  std::map<std::int64_t, std::optional<Eigen::Vector3d>> positions;
  for (const auto& [id, point] : points_) positions.emplace(id, point.position);
  archive(positions);
  if (!archive.restores()) return;
  points_.clear();
  for (const auto& [id, position] : positions) points_.emplace(id, true_point(position));
}

}  // namespace incognita
