// Data association errors of a team's estimator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita {

class StateArchive;

/// Calls use(match, true identity) for each match of a landmark's detection, those of anchors too; `truth` must hold the tick
/// of the snapshot.
template <class Use>
void for_each_association(const Snapshot& snapshot, const AssociationTruth& truth, Use use) {
  std::vector<std::size_t> next(truth.size(), 0);
  for (const SnapshotMatch& match : snapshot.matches) {
    if (match.of_body) continue;
    const auto vehicle = static_cast<std::size_t>(match.body);
    use(match, truth.at(vehicle).at(next[vehicle]++));
  }
}

/// The estimator's landmark ids are unrelated to the true identities: each landmark is attributed to the true
/// landmark whose detection initialized it.
class AssociationScore {
 public:
  explicit AssociationScore(std::shared_ptr<const AssociationTruth> truth) : truth_(std::move(truth)) {}

  /// Adds a snapshot; `truth` must hold the same tick.
  void add(const Snapshot& snapshot);

  std::int64_t right() const { return right_; }  ///< correct matches, without those of anchors
  std::int64_t wrong() const { return wrong_; }
  /// Detections of mapped landmarks that were not matched.
  std::int64_t missed() const { return missed_; }
  int duplicate_landmarks() const { return duplicate_landmarks_; }  ///< of mapped landmarks

  /// Saves or restores which landmark is which, and the duplicates; not the counts, which are of the frames of this run.
  void state(StateArchive& archive);

 private:
  void add(const SnapshotMatch& match, std::int64_t truth, const std::set<std::int64_t>& mapped);

  std::shared_ptr<const AssociationTruth> truth_;
  std::map<std::int64_t, std::int64_t> landmark_of_;  ///< by the estimator's id
  std::int64_t right_ = 0, wrong_ = 0, missed_ = 0;
  int duplicate_landmarks_ = 0;
};

}  // namespace incognita
