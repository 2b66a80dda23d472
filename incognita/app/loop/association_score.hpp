// Data association errors of a team's estimator.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita {

class StateArchive;

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
