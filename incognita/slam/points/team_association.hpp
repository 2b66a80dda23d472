// Data association of detections without identity: nearest neighbor, thesis Section 6.3.1 ("nearest neighbour
// chi-squared tests are computed to guarantee correct matching"), or joint compatibility.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

struct ViewAssociation {
  /// Per detection the number of its landmark or anchor, Detection::unknown where it has none.
  std::vector<std::int64_t> landmarks;
  std::vector<std::size_t>
      candidates;  ///< candidates for new landmarks: outside the wide gate of every landmark
  /// All detections: anchors by number, then the others by their numbers. So the result, to the last bit, does not
  /// depend on the order of the detections, which might give away what they are.
  std::vector<std::size_t> order;
  bool capped = false;  ///< the joint search reached its cap: a better association may exist
};

/// Of the detections of one vehicle. Anchors are known by their identity where settings.anchors_have_identity; no
/// other identity is read. Each landmark has one detection at most and each detection one landmark.
///
/// `nearest` takes the nearest pair first by the squared Mahalanobis distance r' S^-1 r, S = H P H' + R over the errors
/// of vehicle and landmark and their correlations; `joint` takes the largest jointly compatible set
/// (association.hpp). A detection outside every gate and inside a wide one, or nearer to a landmark than
/// `initialization_distance_m`, is neither associated nor a candidate; of two candidates nearer to each other than that, the
/// first is.
ViewAssociation associate_view(const TeamEstimate& estimate, int vehicle,
                               const std::vector<PointDetection>& landmarks, const TeamSettings& settings);

}  // namespace incognita
