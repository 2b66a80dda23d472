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

  /// `target` fixes place and scale; without one the first view is the origin and the scale is the prior's.
  /// `odometry`: of the vehicle that carries the camera, where what its wheels tell is to be used. Throws
  /// std::invalid_argument as validate() of camera_validation.hpp does.
  CameraEstimator(Camera camera, std::optional<Target> target, const CameraSlamSettings& settings,
                  double max_search_s, std::uint64_t seed, const std::optional<WheelOdometry>& odometry = {});

  /// Brings the estimate from the tick before to this one. `command` is what was asked for since then.
  /// The first tick may have any number and any time: what was begun and when stands in the estimate. An
  /// image of another size than the camera's throws std::invalid_argument.
  void update(Estimate& estimate, const Command& command, const Observation& observation, const Tick& tick);

  const Camera& camera() const { return camera_; }
  const CameraSlamSettings& settings() const { return settings_; }

 private:
  /// Images are null where the tick brought none.
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
  SummedImage summed_;  ///< of this tick's image, and its memory: not to be read in a tick without one
};

}  // namespace incognita
