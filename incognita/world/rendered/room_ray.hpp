// Where a ray meets the rendered room.
#pragma once

#include <Eigen/Core>

#include "incognita/world/rendered/room.hpp"

namespace incognita {

/// Distance to the wall or box that a ray from a position meets, in lengths of `direction`, both in world axes; a level
/// floor is assumed.
double ray_length(const RoomLayout& layout, const Eigen::Vector3d& position,
                  const Eigen::Vector3d& direction);

/// The point of a wall, box, floor or uneven ground that a ray from a position in the room meets first, m. On uneven ground
/// within 0.2 mm.
Eigen::Vector3d surface_point(const Room& room, const Eigen::Vector3d& position,
                              const Eigen::Vector3d& direction);

}  // namespace incognita
