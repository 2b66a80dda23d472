#include "incognita/app/loop/point_map_truth.hpp"

#include <algorithm>
#include <utility>

#include "incognita/app/loop/association_score.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {

PointMapTruth::PointMapTruth(const PointLandmarks& points, const std::vector<std::int64_t>& known,
                             std::shared_ptr<const AssociationTruth> associations)
    : associations_(std::move(associations)), mapped_({}) {
  for (const auto& [identity, point] : points) {
    if (std::ranges::find(known, identity) != known.end()) continue;
    Part part{Eigen::Vector3d::Zero(), parts_.size()};
    part.position.head(point.size()) = point;
    parts_.emplace(identity, part);
  }
  mapped_ = MappedShare(std::vector<double>(parts_.size(), 1));
}

/// Null for a landmark of unknown truth.
const PointMapTruth::Part* PointMapTruth::part_of(std::int64_t landmark) const {
  std::int64_t identity = landmark;
  if (associations_) {
    const auto known = identity_of_.find(landmark);
    if (known == identity_of_.end()) return nullptr;
    identity = known->second;
  }
  const auto part = parts_.find(identity);
  return part == parts_.end() ? nullptr : &part->second;
}

void PointMapTruth::put(const std::optional<Truth>& truth, const Estimator&, Snapshot& snapshot) {
  if (associations_ && truth)
    for_each_association(snapshot, *associations_, [&](const SnapshotMatch& match, std::int64_t identity) {
      if (match.outcome == MatchOutcome::initialized && !match.anchor) identity_of_[match.id] = identity;
    });
  mapped_.restart();
  for (SnapshotLandmark& landmark : snapshot.landmarks) {
    const Part* const part = landmark.anchor ? nullptr : part_of(landmark.id);
    if (!part) continue;
    landmark.truth = part->position;
    mapped_.add(part->index, part->position, landmark.position);
  }
  snapshot.mapped = mapped_.share();
}

void PointMapTruth::state(StateArchive& archive) { archive(identity_of_); }

}  // namespace incognita
