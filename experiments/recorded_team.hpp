// Five recorded robots that measure each other and 15 landmarks (UTIAS MRCLAM, set 7): one joint filter,
// thesis (5.16)-(5.19), and others for comparison, over the same 900 s and at the same times.
//
// Fixed before anything was compared: noises of 0.1 m/s and 0.5 rad/s on each reading of the odometry (what
// is recorded are commands), 0.1 m and 3 % of a range, 0.02 rad of a bearing, a gate of 99.9 %, known
// identities, and a start taken from motion capture, known to 1 cm and 0.01 rad.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/run_trace.hpp"
#include "incognita/analysis/evaluation/map_error.hpp"
#include "incognita/world/replay/range_recording.hpp"

namespace incognita::recorded_team {

inline constexpr double duration_s = 900;

using Robots = std::vector<RangeRecording>;

/// Throws InputError, saying where the recording is published, when it is not there.
Robots load();

struct Setup {
  bool see_each_other = true;
  Linearization linearization = Linearization::analytic;
  double input_sigmas_times = 1, sensor_sigmas_times = 1;
};

/// Times since the start.
struct RobotCourse : RunTrace {
  std::vector<double> sigma_m;         ///< of the position, in the worst direction
  double rms_m = 0, fitted_rms_m = 0;  ///< of the position, as it is and after the fit of the landmarks
  double rms_heading_rad = 0;
  double most_sigma_heading_rad = 0;
  double nees = 0;  ///< of the pose over its 3 degrees of freedom, mean
};

struct MappedLandmark {
  std::int64_t identity = 0;
  Eigen::Vector2d estimated, surveyed;
  Eigen::Matrix2d covariance;
  double off_m = 0, fitted_off_m = 0;
};

struct Drive {
  std::vector<RobotCourse> robots;
  std::vector<MappedLandmark> landmarks;
  PlanarFit fit;  ///< rigid, of the estimated landmarks to the surveyed ones
  double map_rms_m = 0, fitted_map_rms_m = 0;
  double nis = 0;  ///< over its degrees of freedom
  int measurements = 0,
      left_out = 0;            ///< measurements of known landmarks and robots; of them, outside the gate
  double longest_blind_s = 0;  ///< without a measurement
  double recorded_s = 0, took_s = 0;  ///< of the recording, and of one processor
  bool lost = false;
};

/// All in one belief.
Drive together(const Robots& robots, const Setup& setup);

/// When a robot alone is evaluated. At its own measurements its times without any do not count, and its start
/// is given at the first of them; in the team it may come later.
enum class Times { of_team, own };

/// One by itself.
Drive alone(const Robots& robots, std::size_t which, const Setup& setup, Times times = Times::of_team);
std::vector<Drive> each_alone(const Robots& robots, const Setup& setup, Times times = Times::of_team);

}  // namespace incognita::recorded_team
