#include "incognita/world/rendered/seen_surface.hpp"

#include <utility>

#include "incognita/math/quaternion.hpp"
#include "incognita/world/rendered/room_ray.hpp"

namespace incognita {

SeenSurface::SeenSurface(std::shared_ptr<const Room> room, Camera camera, double readout_s,
                         PoseAtTime pose_at)
    : room_(std::move(room)),
      camera_(std::move(camera)),
      readout_s_(readout_s),
      pose_at_(std::move(pose_at)) {}

std::optional<Eigen::Vector3d> SeenSurface::at(const Eigen::Vector2d& pixel, const BodyTruth& body,
                                               const Tick& tick) const {
  const auto ray = camera_.unproject(pixel);
  if (!ray || !body.pose) return std::nullopt;
  const RigidPose pose =
      motion_about(tick, body, pose_at_)(row_time_s(pixel.y(), camera_.height(), readout_s_));
  if (!room_->layout().inside.contains(pose.position)) return std::nullopt;
  return surface_point(*room_, pose.position, rotation_matrix<double>(pose.world_from_body) * *ray);
}

}  // namespace incognita
