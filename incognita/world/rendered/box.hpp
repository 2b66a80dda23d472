// Axis-aligned box in world axes: a crate, or the room seen from inside.
#pragma once

#include <Eigen/Core>

namespace incognita {

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();  ///< m, world axes
  Eigen::Vector3d max = Eigen::Vector3d::Zero();

  Box grown(double margin_m) const {
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(margin_m);
    return {min - margin, max + margin};
  }
  bool contains(const Eigen::Vector3d& p) const {
    return (p.array() > min.array()).all() && (p.array() < max.array()).all();
  }
};

}  // namespace incognita
