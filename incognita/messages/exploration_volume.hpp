// The exploration volume: which of its cells a camera or sensor has seen (thesis 6.2, exploration prior).
#pragma once

#include <Eigen/Core>
#include <cstddef>
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

inline bool is_seen(const ExplorationVolume& volume, int cell) {
  return volume.seen[static_cast<std::size_t>(cell / 8)] >> cell % 8 & 1;
}

/// World, m.
inline Eigen::Vector3d center_of(const ExplorationVolume& volume, int cell) {
  const int row = cell / volume.cells.x();
  const Eigen::Vector3i which(cell % volume.cells.x(), row % volume.cells.y(), row / volume.cells.y());
  const Eigen::Vector3d at = which.cast<double>();
  const Eigen::Vector3d size = (volume.max_m - volume.min_m).array() / volume.cells.cast<double>().array();
  return volume.min_m + (at.array() + 0.5).matrix().cwiseProduct(size);
}

}  // namespace incognita
