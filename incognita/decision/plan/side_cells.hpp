// What is expected to be mapped where the exploration volume is a room: one landmark on each cell of its walls, floor and ceiling
// and on the faces of the objects in it (object_faces.hpp).
//
// A cell holds none any more once a landmark of the map is on it or close in front of it. The longer a cell was in view without one,
// the less probable it is that there is one to map: an object hides it, or it has no texture.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/plan/object_faces.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

struct SideCell {
  Eigen::Vector3d center{0, 0, 0}, normal{0, 0, 0};  ///< world, m; inward
  Eigen::Vector3d half_m{0, 0, 0};                   ///< its sides along the axes, half
  double seen_s = 0;
};

class SideCells {
 public:
  /// Throws std::invalid_argument if there were more than 100000 cells.
  explicit SideCells(const ExplorationSettings& settings);

  /// Time in view, in every tick: `in_view` of a position and `camera`, world, m; `dt`, s.
  void see(const std::function<bool(const Eigen::Vector3d&)>& in_view, const Eigen::Vector3d& camera,
           double dt);
  /// Which cells the map covers; renews expected().
  void compare(const Estimate& estimate);

  const std::vector<ExpectedLandmark>& expected() const { return expected_; }
  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  void cover(const Estimate& estimate);

  Eigen::Vector3d min_m_, max_m_;
  double patience_s_;
  std::vector<SideCell> cells_;
  std::vector<bool> covered_;  ///< of each cell, by the map
  ObjectFaces objects_;
  std::vector<ExpectedLandmark> expected_;
};

}  // namespace incognita
