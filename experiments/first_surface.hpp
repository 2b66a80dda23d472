// Where a ray meets the rendered room: the true position of what a pixel shows.
#pragma once

#include <Eigen/Core>

#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

/// Where a ray that starts in the room leaves it or first enters a box. The floor is even.
inline Eigen::Vector3d first_surface(const RoomLayout& room, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& along) {
  const Eigen::Array3d walls = (along.array() > 0).select(room.inside.max.array(), room.inside.min.array());
  double nearest = ((walls - from.array()) / along.array()).minCoeff();
  for (const Box& box : room.boxes) {
    const Eigen::Array3d a = (box.min - from).array() / along.array(),
                         b = (box.max - from).array() / along.array();
    const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
    if (enter > 0 && enter < leave && enter < nearest) nearest = enter;
  }
  return from + nearest * along;
}

}  // namespace incognita
