// Simulated camera in the rendered room.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "incognita/models/sensors/camera.hpp"
#include "incognita/world/image_noise.hpp"
#include "incognita/world/rendered/exposure.hpp"
#include "incognita/world/rendered/room.hpp"
#include "incognita/world/sensor_set.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

/// Pose of the camera at a time of the clock of the ticks, s.
using PoseAtTime = std::function<RigidPose(double t)>;

/// The motion of the camera of a body about a tick: as `pose_at` says, or if that is empty at the velocity and the rate of its
/// true state. Both arguments must outlive it.
PoseInTime motion_about(const Tick& tick, const BodyTruth& body, const PoseAtTime& pose_at);

class RoomCamera final : public BodySensor {
 public:
  /// The room is shared, since painting it is the most expensive part. `name`: of the random stream of the noise, one
  /// per camera.
  RoomCamera(std::shared_ptr<const Room> room, const Camera& camera, const RoomSettings& settings,
             std::uint64_t seed, const std::string& name = "sensor.image",
             const ExposureSettings& exposure = {});

  /// The motion during an exposure, where it is known; by default velocity and rate of the true state are constant.
  void follow(PoseAtTime world_from_camera) { pose_at_ = std::move(world_from_camera); }

  /// The image seen from a pose, at rest. Deterministic: equal seeds and pose sequences give equal images.
  std::shared_ptr<const Image> image_from(const RigidPose& world_from_camera, const Tick& tick);

  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive& archive) override;

 private:
  std::shared_ptr<const Image> image_along(const PoseInTime& world_from_camera, const Tick& tick);
  bool covered(const Tick& tick) const { return cover_lens_from_s_ >= 0 && tick.t >= cover_lens_from_s_; }

  std::shared_ptr<const Room> room_;
  ExposedCamera camera_;
  ExposureGain gain_;
  ImageNoise noise_;
  PoseAtTime pose_at_;  ///< empty: extrapolated
  double cover_lens_from_s_;
};

}  // namespace incognita
