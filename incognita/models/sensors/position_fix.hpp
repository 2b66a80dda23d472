// An external position sensor such as GPS: the second way to full observability in thesis Section 3.2.
// Measurement (2): x, y in the world (m).
#pragma once

#include <Eigen/Core>

#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

struct PositionFix {
  struct Prediction {
    Eigen::Vector2d z;               ///< m
    Eigen::Matrix<double, 2, 3> Hv;  ///< d(z) / d(pose error)
  };
  static Prediction predict_measurement(const planar::Pose<double>& pose) {
    return {pose.head<2>(), Eigen::Matrix<double, 2, 3>::Identity()};
  }
};

}  // namespace incognita
