// Places a recorded motion in the rendered room, so that walls and boxes are not in its way.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/world/motion_spline.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

/// p_room = scale R_z(turn) (p_motion - origin) + start. The vertical of the motion, z, remains vertical.
struct MotionPlacement {
  double scale = 1;
  double turn_rad = 0;
  Eigen::Vector3d origin{0, 0, 0};  ///< first position of the motion
  Eigen::Vector3d start{0, 0, 0};   ///< and where it is in the room

  TimedPose of(const TimedPose& pose) const;
};

struct WantedStart {
  Eigen::Vector3d position{0, 0, 0};
  double heading_rad = 0;
};

/// The placement with the wanted initial heading and the largest scale, at most 1, at which all positions are in the
/// room and at least `clearance_m` from walls and boxes, on the straight lines between them too; among these one that
/// stays farther away, if there is one, and starts near the wanted position. `motion`: camera poses. Throws std::invalid_argument without poses, and UnfitSetting
/// if less than a twentieth of the size fits.
MotionPlacement place_motion(const std::vector<TimedPose>& motion, const RoomLayout& layout,
                             double clearance_m, const WantedStart& wanted);

}  // namespace incognita
