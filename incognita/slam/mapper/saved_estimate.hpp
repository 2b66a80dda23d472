// The state of the estimate: what belongs to the next tick. The report of the last tick and its times do not.
#pragma once

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

/// Saves or restores. Throws DamagedState if landmarks and bodies do not fit the belief.
void estimate_state(StateArchive& archive, Estimate& estimate);

template <AnyStateArchive Archive>
void serialize(Archive& archive, RigidPose& pose) {
  auto& [position, world_from_body] = pose;
  archive(position, world_from_body);
}

}  // namespace incognita
