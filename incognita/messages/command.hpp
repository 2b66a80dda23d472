// What the controller asks of the camera or robot: the input of thesis (5.24).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/math/small_matrix.hpp"

namespace incognita {

struct Command {
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();   ///< m/s^2, world axes
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  ///< rad/s^2, camera axes

  /// It is a hand that moves the camera: these happen, and nobody tells the filter
  bool by_hand = false;

  /// Of a team: each vehicle's, as its motion model takes it; none: stand still
  std::vector<SmallVector> inputs = {};
  /// Of a team: x, y, z (m, world) and heading (rad) where each is to be now; none where it follows nothing
  std::vector<Eigen::Vector4d> wanted = {};

  /// What a filter is told of it, (5.24).
  Eigen::Matrix<double, 6, 1> as_told() const {
    return by_hand ? Eigen::Matrix<double, 6, 1>::Zero().eval() : as_input();
  }
  Eigen::Matrix<double, 6, 1> as_input() const {
    Eigen::Matrix<double, 6, 1> u;
    u << linear_acceleration, angular_acceleration;
    return u;
  }
};

}  // namespace incognita
