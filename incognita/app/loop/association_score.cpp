#include "incognita/app/loop/association_score.hpp"

#include <vector>

namespace incognita {

void AssociationScore::add(const Snapshot& s) {
  std::set<std::int64_t> mapped;  // before the initializations of this tick, which follow in its matches
  for (const SnapshotLandmark& landmark : s.landmarks)
    if (const auto known = landmark_of_.find(landmark.id); known != landmark_of_.end())
      mapped.insert(known->second);
  std::vector<std::size_t> next(truth_->size(), 0);
  for (const SnapshotMatch& match : s.matches) {
    if (match.of_body) continue;
    const auto vehicle = static_cast<std::size_t>(match.body);
    add(match, truth_->at(vehicle).at(next[vehicle]++), mapped);
  }
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
