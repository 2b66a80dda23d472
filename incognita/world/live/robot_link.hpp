// The interface between the loop and a real robot, whatever carries its messages.
#pragma once

#include <Eigen/Core>

#include "incognita/world/live/live_source.hpp"

namespace incognita {

class RobotLink : public LiveSource {
 public:
  /// The velocity from now on: speed, m/s, and turn rate, rad/s, to the left.
  virtual void drive(const Eigen::Vector2d& velocity) = 0;
  /// Stops the robot at once, whatever is commanded, until it is false again. From any thread.
  virtual void set_stopped(bool stopped) = 0;
  virtual bool is_stopped() const = 0;
};

}  // namespace incognita
