#include "incognita/app/loop/room_map_truth.hpp"

#include <map>
#include <utility>

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {

RoomMapTruth::RoomMapTruth(SeenSurface seen, SurfacePatches patches)
    : seen_(std::move(seen)), patches_(std::move(patches)), mapped_(patches_.areas_m2()) {}

/// Ids only grow.
void RoomMapTruth::add_new(const Truth& truth, const TrackedCamera& camera, const Tick& tick) {
  if (camera.body >= truth.bodies.size()) return;
  for (auto it = camera.features.upper_bound(newest_); it != camera.features.end(); ++it) {
    const auto& [id, feature] = *it;
    newest_ = id;
    if (feature.frames_known > 0) continue;  // of another run
    TruePoint point{id, seen_.at(feature.view.pixel, truth.bodies[camera.body], tick), {}};
    if (point.position) point.patch = patches_.patch_at(*point.position);
    points_.push_back(point);
  }
}

/// Only when they are many, so that a frame costs little.
void RoomMapTruth::remove_deleted(const TrackedCamera& camera) {
  constexpr std::size_t few = 100;
  if (points_.size() > 2 * camera.features.size() + few)
    std::erase_if(points_, [&](const TruePoint& point) { return !camera.features.contains(point.landmark); });
}

void RoomMapTruth::put(const std::optional<Truth>& truth, const Estimator& estimator, Snapshot& snapshot) {
  const auto* const slam = dynamic_cast<const SlamEstimator*>(&estimator);
  if (slam && truth && !slam->cameras().empty()) {
    const TrackedCamera& camera = slam->cameras().front().camera();
    add_new(*truth, camera, snapshot.tick);
    remove_deleted(camera);
  }
  mapped_.restart();
  auto point =
      points_.begin();  // the landmarks of a snapshot are in the order of their ids, after the anchors
  for (SnapshotLandmark& landmark : snapshot.landmarks) {
    if (landmark.anchor) continue;
    while (point != points_.end() && point->landmark < landmark.id) ++point;
    if (point == points_.end()) break;
    if (point->landmark != landmark.id || !point->position) continue;
    landmark.truth = point->position;
    mapped_.add(point->patch, *landmark.truth, landmark.position);
  }
  snapshot.mapped = mapped_.share();
}

void RoomMapTruth::state(StateArchive& archive) {
  std::map<std::int64_t, std::optional<Eigen::Vector3d>> positions;
  for (const TruePoint& point : points_) positions.emplace(point.landmark, point.position);
  archive(positions, newest_);
  if (!archive.restores()) return;
  points_.clear();
  for (const auto& [id, position] : positions)
    points_.push_back({id, position, position ? patches_.patch_at(*position) : std::nullopt});
}

}  // namespace incognita
