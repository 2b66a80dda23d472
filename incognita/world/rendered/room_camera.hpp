// Simulated camera in the rendered room.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "incognita/models/sensors/camera.hpp"
#include "incognita/world/image_noise.hpp"
#include "incognita/world/rendered/ray_table.hpp"
#include "incognita/world/rendered/room.hpp"
#include "incognita/world/sensor_set.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

class RoomCamera final : public BodySensor {
 public:
  /// The room is shared, since painting it is the most expensive part. `name`: of the random stream of the noise, one
  /// per camera.
  RoomCamera(std::shared_ptr<const Room> room, const Camera& camera, const RoomSettings& settings,
             std::uint64_t seed, const std::string& name = "sensor.image");

  /// The image seen from a pose. Deterministic: equal seeds and pose sequences give equal images.
  std::shared_ptr<const Image> image_from(const RigidPose& world_from_camera, const Tick& tick);

  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;

 private:
  bool covered(const Tick& tick) const { return cover_lens_from_s_ >= 0 && tick.t >= cover_lens_from_s_; }

  std::shared_ptr<const Room> room_;
  RayTable rays_;
  ImageNoise noise_;
  double cover_lens_from_s_;
};

}  // namespace incognita
