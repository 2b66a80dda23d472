// The point of the rendered room that a pixel of an image shows.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "incognita/messages/tick.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/world/rendered/room.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

class SeenSurface {
 public:
  /// `readout_s`: of a rolling shutter, else 0. `pose_at`: as RoomCamera::follow(); empty without.
  SeenSurface(std::shared_ptr<const Room> room, Camera camera, double readout_s, PoseAtTime pose_at = {});

  /// Where the true ray of a pixel meets the room, m: from the true pose of the camera when it exposed the row of that pixel.
  /// Nothing if no ray maps to the pixel, or if the camera is outside of the room or has no true pose.
  std::optional<Eigen::Vector3d> at(const Eigen::Vector2d& pixel, const BodyTruth& body,
                                    const Tick& tick) const;

 private:
  std::shared_ptr<const Room> room_;
  Camera camera_;
  double readout_s_;
  PoseAtTime pose_at_;
};

}  // namespace incognita
