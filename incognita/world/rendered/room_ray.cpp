#include "incognita/world/rendered/room_ray.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace incognita {
namespace {

/// Parameters at which a ray enters and leaves a box; it misses the box if it leaves before it enters.
std::pair<double, double> crossing(const Box& box, const Eigen::Vector3d& position,
                                   const Eigen::Vector3d& direction) {
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.min[i] - position[i]) / direction[i], b = (box.max[i] - position[i]) / direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave};
}

std::array<float, 3> as_floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

double ray_length(const RoomLayout& layout, const Eigen::Vector3d& position,
                  const Eigen::Vector3d& direction) {
  double length = crossing(layout.inside, position, direction).second;
  for (const Box& box : layout.boxes)
    if (const auto [enter, leave] = crossing(box, position, direction); enter > 0 && enter < leave)
      length = std::min(length, enter);
  return length;
}

Eigen::Vector3d surface_point(const Room& room, const Eigen::Vector3d& position,
                              const Eigen::Vector3d& direction) {
  const double length = ray_length(room.layout(), position, direction);
  if (const Ground* ground = room.ground()) {
    const auto most = static_cast<float>(length);
    if (const float to_ground = ground->meet(as_floats(position), as_floats(direction), most);
        to_ground < most)
      return position + double{to_ground} * direction;
  }
  return position + length * direction;
}

}  // namespace incognita
