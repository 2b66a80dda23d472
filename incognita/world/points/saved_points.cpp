// The state of simulated point sensors.
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita {

void PointDetector::state(StateArchive& archive) {
  auto& [motion, sensor, targets, ticks, noise, associations, index] = *this;
  archive(ticks, noise);
}

}  // namespace incognita
