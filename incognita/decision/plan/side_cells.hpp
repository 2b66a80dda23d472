// What is expected to be mapped where the exploration volume is a room: one landmark on each cell of its walls, floor and ceiling.
//
// A cell holds none any more once a landmark of the map is there, or once it was seen for so long that one would be: boxes hide it,
// or it has no texture. A cell is seen only from where its texture can be matched, not along the surface.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class SideCells {
 public:
  SideCells(const ExplorationSettings& settings, double cell_m, double patience_s);

  /// Time in view, in every tick.
  void see(const std::function<bool(const Eigen::Vector3d&)>& in_view, const Eigen::Vector3d& camera,
           double dt);
  /// Which cells the map covers; renews expected().
  void compare(const Estimate& estimate);

  const std::vector<ExpectedLandmark>& expected() const { return expected_; }
  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

  int count() const { return static_cast<int>(cells_.size()); }

 private:
  struct Cell {
    Eigen::Vector3d center, normal;
    double seen_s = 0;
  };
  void add_side(int axis, bool upper, const ExplorationSettings& settings, double cell_m);

  double cell_m_, patience_s_;
  std::vector<Cell> cells_;
  std::vector<ExpectedLandmark> expected_;
};

/// Sine of the angle to a surface from which a landmark on it can be matched.
inline constexpr double least_sine_to_surface = 0.5;

/// Whether `camera` sees a surface at `position` well enough; always without a normal (zero).
inline bool sees_surface(const Eigen::Vector3d& camera, const Eigen::Vector3d& position,
                         const Eigen::Vector3d& normal) {
  return normal.isZero() ||
         normal.dot(camera - position) >= least_sine_to_surface * (camera - position).norm();
}

}  // namespace incognita
