// Wheel odometry as a measurement of the camera that the vehicle carries.
#pragma once

#include <Eigen/Core>

#include "incognita/belief/belief.hpp"
#include "incognita/models/wheel_odometry.hpp"

namespace incognita {

/// Updates the belief by a reading of the wheels: speed (m/s) and turn rate (rad/s, to the left), the means
/// over the tick, which are those of the state, as (5.24) moves with them.
UpdateReport update_with_wheel_odometry(Belief& belief, BlockId camera, const WheelOdometry& odometry,
                                        const Eigen::Vector2d& wheels);

}  // namespace incognita
