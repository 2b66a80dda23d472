// The exploration volume: which of its cells a camera or sensor has seen (thesis 6.2, exploration prior).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace incognita {

/// Immutable once shared. A cell is at x + cells.x() * (y + cells.y() * z).
struct ExplorationVolume {
  Eigen::Vector3d min_m{0, 0, 0};  ///< world: lower corner
  Eigen::Vector3d max_m{0, 0, 0};  ///< world: upper corner
  double cell_m = 0;               ///< wanted edge of a cell: they are shrunk to fill the volume
  Eigen::Vector3i cells{0, 0, 0};  ///< per axis
  std::vector<std::uint8_t> seen;  ///< one bit per cell, the lowest bit of a byte first; unused bits are 0
};

}  // namespace incognita
