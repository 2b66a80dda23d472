// The interface between the loop and a real robot, whatever carries its messages.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/messages/observation.hpp"

namespace incognita {

/// An image and the odometry that came with it, as the robot stamped them.
struct RobotReading {
  double t = 0;  ///< s, of the image, on the robot's clock, in whole microseconds
  std::shared_ptr<const Image> image;
  std::vector<Odometry> odometry = {};  ///< all that came since the last reading, in any order
};

class RobotLink {
 public:
  virtual ~RobotLink() = default;
  /// The newest image that has not been returned; waits for it. Nothing if none comes in time.
  virtual std::optional<RobotReading> read(double wait_s) = 0;
  /// The velocity from now on: speed, m/s, and turn rate, rad/s, to the left.
  virtual void drive(const Eigen::Vector2d& velocity) = 0;
  /// Stops the robot at once, whatever is commanded, until it is false again. From any thread.
  virtual void set_stopped(bool stopped) = 0;
  virtual bool is_stopped() const = 0;
  /// Why nothing comes, and the remedy.
  virtual std::string problem() const = 0;
  /// What happened since the last call, for printing.
  virtual std::vector<std::string> take_events() = 0;
  /// For the summary of a run: name and number.
  virtual std::vector<std::pair<std::string, std::int64_t>> counts() const { return {}; }
};

}  // namespace incognita
