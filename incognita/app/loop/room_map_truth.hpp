// The true positions of the landmarks of an image-based map of the rendered room.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/analysis/evaluation/mapped_share.hpp"
#include "incognita/app/loop/map_truth.hpp"
#include "incognita/slam/features/feature.hpp"
#include "incognita/world/rendered/seen_surface.hpp"
#include "incognita/world/rendered/surface_patches.hpp"

namespace incognita {

/// A landmark is the patch at one pixel of the image in which it began: its true position is where the true ray of that pixel
/// met the room. The parts of the world are the patches of its surfaces. Landmarks of the map of another run, and those of an
/// estimator that is not a SlamEstimator, have no known truth and map nothing.
class RoomMapTruth final : public MapTruth {
 public:
  RoomMapTruth(SeenSurface seen, SurfacePatches patches);

  void put(const std::optional<Truth>& truth, const Estimator& estimator, Snapshot& snapshot) override;
  void state(StateArchive& archive) override;

 private:
  /// Of a landmark that began in this run.
  struct TruePoint {
    std::int64_t landmark = 0;
    std::optional<Eigen::Vector3d> position;
    std::optional<std::size_t> patch;
  };
  void add_new(const Truth& truth, const TrackedCamera& camera, const Tick& tick);
  void remove_deleted(const TrackedCamera& camera);

  SeenSurface seen_;
  SurfacePatches patches_;
  MappedShare mapped_;
  std::vector<TruePoint>
      points_;                ///< in the order of the landmarks' ids; some are of landmarks that were deleted
  std::int64_t newest_ = -1;  ///< greatest id of a landmark so far
};

}  // namespace incognita
