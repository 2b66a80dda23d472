// Layout of the rendered room.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incognita/world/rendered/box.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

/// The known target: a black rectangle on a white sheet, on the wall at +x, facing the room.
struct Sheet {
  double x = 0;               ///< position of its wall
  double y = 0, z = 1.3;      ///< center
  double width = 0.70;        ///< along y
  double height = 0.56;       ///< along z
  double black_width = 0.42;  ///< an A3 sheet of black paper
  double black_height = 0.297;

  /// Corners of the black rectangle: top left, top right, bottom right, bottom left as someone facing it sees them.
  std::array<Eigen::Vector3d, 4> corners() const;
  Eigen::Vector3d normal() const { return {-1, 0, 0}; }
};

struct RoomLayout {
  Box inside;              ///< interior of the room, floor at z = 0, or below uneven ground
  std::vector<Box> boxes;  ///< boxes on the floor against a wall, apart from each other
  Sheet sheet;
};

/// Draws the positions of the boxes. Throws std::invalid_argument if a setting is invalid, and UnfitSetting if the boxes
/// do not fit along the walls outside the corridor between start and target.
RoomLayout room_layout(const RoomSettings& settings, std::uint64_t seed);

}  // namespace incognita
