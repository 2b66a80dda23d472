// The state of the front end of the point sensors.
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/points/prune_landmarks.hpp"

namespace incognita {

void LandmarkPruning::Reach::state(StateArchive& archive) {
  auto& [least_, most_] = *this;
  archive(least_, most_);
}

void LandmarkPruning::state(StateArchive& archive) {
  auto& [reaches, matched] = *this;
  archive(reaches);
}

}  // namespace incognita
