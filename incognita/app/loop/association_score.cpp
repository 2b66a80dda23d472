#include "incognita/app/loop/association_score.hpp"

#include <vector>

namespace incognita {

void AssociationScore::add(const Snapshot& s) {
  std::set<std::int64_t> mapped;  // before this tick's births, which are told at its end
  for (const SnapshotLandmark& landmark : s.landmarks)
    if (const auto known = landmark_of_.find(landmark.id); known != landmark_of_.end())
      mapped.insert(known->second);
  std::vector<std::size_t> next(truth_->size(), 0);
  for (const SnapshotLook& look : s.looks) {
    if (look.of_vehicle) continue;
    const auto vehicle = static_cast<std::size_t>(look.vehicle);
    add(look, truth_->at(vehicle).at(next[vehicle]++), mapped);
  }
}

void AssociationScore::add(const SnapshotLook& look, std::int64_t truth,
                           const std::set<std::int64_t>& mapped) {
  if (look.anchor) return;
  if (look.outcome == LookOutcome::born) {
    landmark_of_[look.id] = truth;
    born_again_ += mapped.count(truth) > 0;
  } else if (look.outcome == LookOutcome::matched) {
    ++(landmark_of_.at(look.id) == truth ? right_ : wrong_);
  } else {
    missed_ += mapped.count(truth) > 0;
  }
}

}  // namespace incognita
