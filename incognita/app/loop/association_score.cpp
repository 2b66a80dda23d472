#include "incognita/app/loop/association_score.hpp"

namespace incognita {

void AssociationScore::add(const Snapshot& s) {
  std::set<std::int64_t> mapped;  // before the initializations of this tick, which follow in its matches
  for (const SnapshotLandmark& landmark : s.landmarks)
    if (const auto known = landmark_of_.find(landmark.id); known != landmark_of_.end())
      mapped.insert(known->second);
  for_each_association(s, *truth_,
                       [&](const SnapshotMatch& match, std::int64_t truth) { add(match, truth, mapped); });
}

void AssociationScore::add(const SnapshotMatch& match, std::int64_t truth,
                           const std::set<std::int64_t>& mapped) {
  if (match.anchor) return;
  if (match.outcome == MatchOutcome::initialized) {
    landmark_of_[match.id] = truth;
    duplicate_landmarks_ += mapped.count(truth) > 0;
  } else if (match.outcome == MatchOutcome::matched) {
    ++(landmark_of_.at(match.id) == truth ? right_ : wrong_);
  } else {
    missed_ += mapped.count(truth) > 0;
  }
}

}  // namespace incognita
