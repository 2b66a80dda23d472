// The state of the sensors in the rendered room.
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/world/rendered/proximity_ring.hpp"
#include "incognita/world/rendered/room_camera.hpp"

namespace incognita {

void ExposureGain::state(StateArchive& archive) {
  auto& [settings, random, gain, next_s, steps] = *this;
  archive(random, gain, next_s, steps);
}

void RoomCamera::state(StateArchive& archive) {
  auto& [room, camera, gain, noise, pose_at, cover_lens_from_s] = *this;
  archive(gain, noise);
}

void ProximityRing::state(StateArchive& archive) {
  auto& [plan, ring, noise] = *this;
  archive(noise);
}

}  // namespace incognita
