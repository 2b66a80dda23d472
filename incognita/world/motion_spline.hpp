// Smooth motion through poses with time stamps, e.g. those of a motion capture system.
//
// Between two samples the position is a cubic (Hermite), and the orientation is q_k exp(r(s)) with a cubic r(s) whose
// ends have the angular rates of the samples: pose, velocity and angular rate are continuous, and every sample is hit.
// The rate of a sample is that of the parabola through it and its neighbors.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/models/motion/rigid_pose.hpp"

namespace incognita {

struct TimedPose {
  double t = 0;  ///< s
  RigidPose pose;
};

struct MovingPose {
  RigidPose pose;
  Eigen::Vector3d velocity{0, 0, 0};  ///< m/s, world axes
  Eigen::Vector3d rate{0, 0, 0};      ///< rad/s, body axes
};

/// The pose after `dt_s` seconds, also negative, at constant velocity and angular rate.
RigidPose extrapolated(const MovingPose& now, double dt_s);

class MotionSpline {
 public:
  /// Throws std::invalid_argument for fewer than two samples, times that do not increase, or numbers that are not
  /// finite. Quaternions must be unit quaternions.
  explicit MotionSpline(std::vector<TimedPose> samples);

  double first_s() const { return samples_.front().t; }
  double last_s() const { return samples_.back().t; }
  /// Before the first and after the last sample velocity and angular rate are constant.
  MovingPose at(double t) const;

 private:
  MovingPose sample(std::size_t k) const { return {samples_[k].pose, velocities_[k], rates_[k]}; }
  MovingPose between(std::size_t k, double t) const;

  std::vector<TimedPose> samples_;
  std::vector<Eigen::Vector3d> velocities_, rates_;  ///< of the samples
};

}  // namespace incognita
