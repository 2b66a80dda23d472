// Renders the noise-free image of a camera in the room.
#pragma once

#include <Eigen/Core>

#include "incognita/vision/image.hpp"
#include "incognita/world/rendered/ray_table.hpp"
#include "incognita/world/rendered/room.hpp"

namespace incognita {

/// Casts the exact ray of every pixel. Pixels without a ray are black, as is the whole image outside the room
/// or below its ground. `world_from_camera`: unit quaternion w,x,y,z. `out` is resized to the table and
/// reuses its memory.
void render(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
            const Eigen::Vector4d& world_from_camera, Image& out);

}  // namespace incognita
