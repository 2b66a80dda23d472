// The state of the front end of the point sensors.
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/points/depth_lines.hpp"
#include "incognita/slam/points/prune_landmarks.hpp"

namespace incognita {

void LandmarkPruning::Reach::state(StateArchive& archive) {
  auto& [least_, most_] = *this;
  archive(least_, most_);
}

void DepthLine::state(StateArchive& archive) {
  auto& [body_, sensor_, depths_, failures_] = *this;
  archive(body_, sensor_, depths_, failures_);
}

void DepthLines::state(StateArchive& archive) {
  auto& [lines] = *this;
  archive(lines);
}

void LandmarkPruning::state(StateArchive& archive) {
  auto& [reaches, matched] = *this;
  archive(reaches);
}

}  // namespace incognita
