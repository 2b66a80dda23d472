// What a camera in the room sees, free of noise.
#pragma once

#include <Eigen/Core>

#include "incognita/vision/image.hpp"
#include "incognita/world/rendered/ray_table.hpp"
#include "incognita/world/rendered/room.hpp"

namespace incognita {

/// Casts the exact ray of every pixel; pixels without a ray are black, as is everything seen from outside the
/// room or from under its ground. `world_from_camera` is a unit quaternion w,x,y,z. `out` gets the size of
/// the table and keeps its memory.
void render(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
            const Eigen::Vector4d& world_from_camera, Image& out);

}  // namespace incognita
