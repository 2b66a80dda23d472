// Loop closure after drift: landmarks that return are in the image, but not where the estimate expects them. They are recognized
// as by a lost camera, in a map of the landmarks alone that were known when these were seen last. The pose that they give shows
// the drift.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/slam/features/relocalization.hpp"
#include "incognita/slam/mapper/drift.hpp"

namespace incognita {

class StateArchive;

/// Landmarks that came back into the predicted view and are not found, while hardly any landmark is found that was known when they
/// were seen last: either the pose is wrong, or they are.
struct MissedLandmarks {
  std::vector<std::int64_t> ids;      ///< empty if others are found: then it is these that changed
  std::vector<std::int64_t> new_ids;  ///< those of them that came into view a short time ago
  int frames_gone = 0;                ///< since they were seen last, median

  /// Whether the landmark may be right and the pose wrong.
  bool may_be_right(std::int64_t id) const;
};

/// Of the matches of this frame. Allocates only if landmarks are missed.
MissedLandmarks missed_landmarks(const TrackedCamera& camera);

struct ClosedLoop {
  DriftCorrection correction;
  std::vector<DriftingLandmark> landmarks;  ///< of this camera, that drifted with it
  std::vector<std::int64_t> missed;         ///< which the correction is to bring back
  int frames = 0;                           ///< since the missed were seen last, while the drift grew
};

class LoopClosure {
 public:
  explicit LoopClosure(std::uint64_t seed) : known_(seed) {}

  /// One frame of a camera that tracks, after its search, at time `t`, s. A loop once as many consecutive frames as
  /// RelocalizationSettings asks for confirmed the pose; nothing otherwise. Landmarks are recognized only while enough of them are
  /// missed.
  std::optional<ClosedLoop> find(const SummedImage& image, const Estimate& estimate,
                                 const TrackedCamera& camera, double t);
  /// Forgets a pose that is not confirmed yet.
  void restart() { known_.restart(); }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  Relocalization known_;
  int frames_until_search_ = 0;
};

/// Moves the views of the landmarks that drifted, and the planes of their patches, with them. Failed searches for those that were
/// missed no longer count.
void move_views(TrackedCamera& camera, const ClosedLoop& loop);

/// Whether, searched again after the correction, most landmarks that were missed match, and hardly any that drifted and matched
/// `before` does no longer; of these, at least half must have been searched for again.
bool confirms(const ClosedLoop& loop, const TrackedCamera& corrected, const TrackedCamera& before);

}  // namespace incognita
