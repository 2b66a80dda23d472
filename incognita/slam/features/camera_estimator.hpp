// Single-camera SLAM: thesis Appendix C, one frame at a time.
#pragma once

#include <optional>

#include "incognita/math/random.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/models/wheel_odometry.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

class StageClock;

class CameraEstimator {
 public:
  using Estimate = incognita::Estimate;

  /// `target` defines world frame and scale; without one the first view is the origin and the scale is that
  /// of the depth prior. `odometry`: model of the carrier's wheel odometry, if it is to be used. Throws
  /// std::invalid_argument as validate() of camera_validation.hpp does.
  CameraEstimator(Camera camera, std::optional<Target> target, const CameraSlamSettings& settings,
                  double max_search_s, std::uint64_t seed, const std::optional<WheelOdometry>& odometry = {});

  /// Advances the estimate from the previous tick to this one. `command` is the input since then. All state
  /// is in the estimate, so the first tick may have any number and time. Throws std::invalid_argument for an
  /// image whose size is not that of the camera.
  void update(Estimate& estimate, const Command& command, const Observation& observation, const Tick& tick);

  const Camera& camera() const { return camera_; }
  const CameraSlamSettings& settings() const { return settings_; }

 private:
  /// Images are null at a tick without one.
  void start(Estimate& estimate, const SummedImage* summed, const Tick& tick, StageClock& clock);
  void start_at(Estimate& estimate, const CameraState& x, const Eigen::Matrix<double, 6, 6>& pose_cov);
  void predict(Estimate& estimate, const Command& command, double dt) const;
  void track(Estimate& estimate, const SummedImage* summed, const Tick& tick, StageClock& clock);
  void match(Estimate& estimate, const SummedImage& summed, StageClock& clock);
  void maintain_map(Estimate& estimate, const SummedImage& summed, StageClock& clock);
  void wait_in_place(Estimate& estimate, const SummedImage* summed);
  void declare_lost(Estimate& estimate) const;
  void correct(Estimate& estimate) const;
  void add_landmarks(Estimate& estimate, const Image& image);
  static void refresh_entropy(Estimate& estimate, const Tick& tick);

  Camera camera_;
  std::optional<Target> target_;
  CameraSlamSettings settings_;
  double max_search_s_;
  std::optional<WheelOdometry> odometry_;
  RandomStream random_;
  SummedImage summed_;  ///< of the current image; reused storage, invalid at a tick without an image
};

}  // namespace incognita
