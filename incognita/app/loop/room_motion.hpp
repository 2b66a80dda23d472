// A recorded motion that the camera of the rendered room follows.
#pragma once

#include <memory>
#include <string>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/world/motion_spline.hpp"
#include "incognita/world/rendered/room_layout.hpp"
#include "incognita/world/replay/replay.hpp"

namespace incognita {

struct RoomMotion {
  std::shared_ptr<const MotionSpline> world_from_camera;  ///< in the room, from t = 0
  double duration_s = 0;
  std::vector<std::string> notes = {};  ///< placement and unused data, for printing
};

/// The trajectory of motion.file, placed in the room. Throws InputError naming file and line or setting, e.g. for gaps in
/// the trajectory, and UnfitSetting as place_motion().
RoomMotion motion_in_room(const LoadedScenario& loaded, const RoomLayout& layout);

/// The true pose, velocity and angular rate of the camera.
RecordedTruth truth_of(const RoomMotion& motion);

}  // namespace incognita
