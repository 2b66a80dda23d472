// Renders the noise-free image of a camera in the room.
#pragma once

#include <Eigen/Core>
#include <span>

#include "incognita/models/motion/rigid_pose.hpp"
#include "incognita/vision/image.hpp"
#include "incognita/world/rendered/ray_table.hpp"
#include "incognita/world/rendered/room.hpp"

namespace incognita {

/// Casts the exact ray of every pixel. Pixels without a ray are black, as is the whole image outside the room
/// or below its ground. `world_from_camera`: unit quaternion w,x,y,z. `out` is resized to the table and
/// reuses its memory.
void render(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
            const Eigen::Vector4d& world_from_camera, Image& out);

/// The same from one pose, or from one per row, for a rolling shutter: the poses of neighboring rows must differ by a
/// fraction of a pixel. Throws std::invalid_argument for another number of poses.
void render(const Room& room, const RayTable& rays, std::span<const RigidPose> row_poses, Image& out);

}  // namespace incognita
