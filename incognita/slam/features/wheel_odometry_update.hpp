// Wheel odometry of the carrier as a measurement of the camera.
#pragma once

#include <Eigen/Core>

#include "incognita/belief/belief.hpp"
#include "incognita/models/wheel_odometry.hpp"

namespace incognita {

/// Updates the belief with a wheel reading: speed (m/s) and turn rate (rad/s, positive to the left), means
/// over the tick. In (5.24) the velocity of the state is constant over the tick, hence the mean.
UpdateReport update_with_wheel_odometry(Belief& belief, BlockId camera, const WheelOdometry& odometry,
                                        const Eigen::Vector2d& wheels);

}  // namespace incognita
