// What is expected to be mapped of objects in the exploration volume, whose shape is not known.
//
// Where the map has landmarks away from the sides of the volume there is an object. It is taken to fill the cell that they are in:
// each face of the cell that the map does not cover yet holds an expected landmark, if there is room to look at it from. So a camera
// that has mapped the front of an object looks for its other sides.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class ObjectFaces {
 public:
  /// `first_index`: of the landmarks expected here.
  ObjectFaces(const ExplorationSettings& settings, int first_index);

  /// Time in view, in every tick: `in_view` of a position and `camera`, world, m; `dt`, s.
  void see(const std::function<bool(const Eigen::Vector3d&)>& in_view, const Eigen::Vector3d& camera,
           double dt);
  /// Which faces there are, and which of them the map covers; renews expected().
  void compare(const Estimate& estimate);

  const std::vector<ExpectedLandmark>& expected() const { return expected_; }
  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  Eigen::Vector3i cell_of(const Eigen::Vector3d& position) const;
  int number_of(const Eigen::Vector3i& cell) const;
  void add_faces(const Eigen::Vector3i& cell, const std::vector<Eigen::Vector3d>& landmarks,
                 const std::map<int, std::vector<Eigen::Vector3d>>& objects);

  Eigen::Vector3d min_m_, max_m_, size_m_;  ///< of the volume, and of a cell
  Eigen::Vector3i cells_;
  double patience_s_;
  int first_index_;
  std::map<int, double> seen_s_;  ///< by index of the face
  std::vector<ExpectedLandmark> expected_;
};

}  // namespace incognita
