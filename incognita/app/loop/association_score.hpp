// How often a team's estimator took a sighting for the landmark that it is of.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/world/points/team_world.hpp"

namespace incognita {

/// The estimator's numbers say nothing of the truth: each is held to be the landmark of whose sighting it was
/// born.
class AssociationScore {
 public:
  explicit AssociationScore(std::shared_ptr<const AssociationTruth> truth) : truth_(std::move(truth)) {}

  /// Of the tick that the truth is of.
  void add(const Snapshot& snapshot);

  std::int64_t right() const { return right_; }  ///< matches, without those of anchors, which have names
  std::int64_t wrong() const { return wrong_; }
  /// Sightings of landmarks that were in the map, and matched with none.
  std::int64_t missed() const { return missed_; }
  int duplicate_landmarks() const { return duplicate_landmarks_; }  ///< births of what was in the map

 private:
  void add(const SnapshotMatch& match, std::int64_t truth, const std::set<std::int64_t>& mapped);

  std::shared_ptr<const AssociationTruth> truth_;
  std::map<std::int64_t, std::int64_t> landmark_of_;  ///< by the estimator's number
  std::int64_t right_ = 0, wrong_ = 0, missed_ = 0;
  int duplicate_landmarks_ = 0;
};

}  // namespace incognita
