// Exposure of the simulated camera in the rendered room: motion blur, rolling shutter, and steps of the gain.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/rigid_pose.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/vision/image.hpp"
#include "incognita/world/rendered/ray_table.hpp"
#include "incognita/world/rendered/room.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

class StateArchive;

/// Pose of the camera at a time after the middle of the exposure of the middle row, s, also negative.
using PoseInTime = std::function<RigidPose(double dt_s)>;

/// When a row, counted from 0 and also between two, is exposed: s after the middle of the image's exposure.
double row_time_s(double row, int rows, double readout_s);

class ExposedCamera {
 public:
  /// The room must outlive it. Durations in s, not negative: throws std::invalid_argument otherwise.
  ExposedCamera(const Room& room, const Camera& camera, double duration_s, double readout_s);

  /// The noise-free image. Row v is exposed about row_time_s(v). Blur is the mean of
  /// images() renderings at equal intervals: a mean of gray levels, so the response of the camera is linear.
  void expose(const PoseInTime& world_from_camera, Image& out);

  /// The number of renderings: each stands for at most 1.5 px of motion in the image, up to 32; 1 below 0.5 px.
  int images(const PoseInTime& world_from_camera) const;

  const RayTable& rays() const { return rays_; }

 private:
  double motion_px(const RigidPose& before, const RigidPose& after) const;
  void render_at(const PoseInTime& world_from_camera, double dt_s, Image& out);

  const Room& room_;
  Camera camera_;
  RayTable rays_;
  double duration_s_, readout_s_;
  std::vector<RigidPose> rows_;      ///< reused memory
  std::vector<std::uint16_t> sums_;  ///< of gray levels
};

/// The gain of the camera over time: 1 until the first step.
class ExposureGain {
 public:
  /// `name`: of its random stream. Throws std::invalid_argument for a ratio below 1, an interval that is not positive, or
  /// times that do not increase.
  ExposureGain(const ExposureSettings& settings, std::uint64_t seed, const std::string& name);

  /// At a time that is not before that of the previous call, s.
  double at(double t);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  double next_gain();
  double next_time();

  ExposureSettings settings_;
  RandomStream random_;
  double gain_ = 1, next_s_ = 0;
  std::size_t steps_ = 0;
};

}  // namespace incognita
