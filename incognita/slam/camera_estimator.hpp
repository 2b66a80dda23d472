// Single-camera SLAM: thesis Appendix C, one frame at a time.
#pragma once

#include <optional>

#include "incognita/math/random.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/models/wheel_odometry.hpp"
#include "incognita/slam/estimate.hpp"
#include "incognita/slam/settings.hpp"
#include "incognita/slam/target.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

class StageClock;

class CameraEstimator {
 public:
  using Estimate = incognita::Estimate;

  /// `target` fixes place and scale; without one the first view is the origin and the scale is the prior's.
  /// `odometry`: of the vehicle that carries the camera, where what its wheels tell is to be used.
  CameraEstimator(Camera camera, std::optional<Target> target, const CameraSlamSettings& settings,
                  double max_search_s, std::uint64_t seed, const std::optional<WheelOdometry>& odometry = {});

  /// Brings the estimate from the tick before to this one. `command` is what was asked for since then.
  /// An image of another size than the camera's throws std::invalid_argument.
  void update(Estimate& estimate, const Command& command, const Observation& seen, const Tick& tick);

  const Camera& camera() const { return camera_; }
  const CameraSlamSettings& settings() const { return settings_; }

 private:
  void start(Estimate& estimate, const Image& image, const Tick& tick, StageClock& clock);
  void start_at(Estimate& estimate, const CameraState& x, const Eigen::Matrix<double, 6, 6>& pose_cov);
  void predict(Estimate& estimate, const Command& command, double dt) const;
  void follow_wheels(Estimate& estimate, const Observation& seen) const;
  void track(Estimate& estimate, const Image& image, const Tick& tick, StageClock& clock);
  void wait_in_place(Estimate& estimate, const Image& image);
  void get_lost(Estimate& estimate) const;
  void correct(Estimate& estimate) const;
  void add_landmarks(Estimate& estimate, const Image& image);
  void refresh_entropy(Estimate& estimate, const Tick& tick);

  Camera camera_;
  std::optional<Target> target_;
  CameraSlamSettings settings_;
  double max_search_s_;
  std::optional<WheelOdometry> odometry_;
  RandomStream random_;
  SummedImage summed_;
  double first_t_ = 0;
  double entropy_t_ = -1e9;
};

}  // namespace incognita
