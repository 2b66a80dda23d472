// Data association of detections without identity: nearest neighbor, thesis Section 6.3.1 ("nearest neighbour
// chi-squared tests are computed to guarantee correct matching"), or joint compatibility.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

struct ViewAssociation {
  /// Per detection the number of its landmark or anchor; Detection::unknown without association.
  std::vector<std::int64_t> landmarks;
  std::vector<std::size_t> candidates;  ///< outside the initialization gate of every landmark
  /// All detections: anchors by identity, then the others sorted by their measurements. The result is
  /// therefore bitwise independent of the order of the detections, which could reveal their identities.
  std::vector<std::size_t> order;
  bool capped = false;  ///< the joint search reached its node limit: a better association may exist
};

/// Associates the landmark detections of one sensor of a body. Anchors are matched by identity if
/// settings.anchors_have_identity; no other identity is used. Each landmark gets at most one detection and
/// vice versa.
///
/// `nearest` assigns the nearest pair first by the squared Mahalanobis distance r' S^-1 r, S = H P H' + R,
/// with the cross covariances of vehicle and landmark; `joint` takes the largest jointly compatible set
/// (association.hpp). A detection outside every gate but inside an initialization gate, or nearer to a
/// landmark than `initialization_distance_m`, is neither associated nor a candidate; of two candidates nearer
/// to each other than that, only the first is kept.
ViewAssociation associate_view(const Estimate& estimate, int body,
                               const std::vector<PointDetection>& landmarks,
                               const EstimatorSettings& settings);

}  // namespace incognita
