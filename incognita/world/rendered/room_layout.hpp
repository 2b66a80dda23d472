// Where things stand in the rendered room.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incognita/world/rendered/box.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

/// The known target: a black rectangle on a white sheet, on the wall at +x, facing the room.
struct Sheet {
  double x = 0;               ///< of the wall it hangs on
  double y = 0, z = 1.3;      ///< its centre
  double width = 0.70;        ///< along y
  double height = 0.56;       ///< along z
  double black_width = 0.42;  ///< an A3 sheet of black paper
  double black_height = 0.297;

  /// Corners of the black rectangle: top left, top right, bottom right, bottom left as someone facing it sees
  /// them.
  std::array<Eigen::Vector3d, 4> corners() const;
  Eigen::Vector3d normal() const { return {-1, 0, 0}; }
};

struct RoomLayout {
  Box inside;              ///< the room itself, floor at z = 0, or below uneven ground
  std::vector<Box> boxes;  ///< stand on the floor and touch a wall, apart from each other
  Sheet sheet;
};

/// Draws where the boxes stand. Throws std::invalid_argument when a setting cannot be, or so many boxes do
/// not fit along the walls without standing between the start and the target.
RoomLayout room_layout(const RoomSettings& settings, std::uint64_t seed);

}  // namespace incognita
