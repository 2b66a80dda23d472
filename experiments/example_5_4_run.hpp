// The camera of thesis Example 5.4 in closed loop: it moves freely (5.24), observes points in a room (5.26),
// estimates them and itself in one belief, and is steered along a path by its estimate (5.29).
//
// World z-up: the room's 6 x 2 x 8 m (x, y up, z) are y, z and x here, about the origin, which is the path's
// center: the camera starts at (-1.5, 0, 0) and faces +x.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "incognita/control/paths/reference_path.hpp"
#include "incognita/control/settings.hpp"
#include "incognita/control/steering.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/sensors/camera.hpp"

namespace incognita::swinging_camera {

inline constexpr double settled_s = 5;

enum class Law {
  corrected,        ///< control/track_reference.hpp
  as_printed,       ///< (5.29): `v - y*`, no acceleration, nothing for the orientation
  velocity_mended,  ///< the same with `v - v*`
  rate_alone        ///< corrected but for the orientation, of which (5.29) has nothing
};

/// What the thesis does not print is that of the project's room and of Davison's camera.
struct Setup {
  Path path = BackAndForthPath{};
  Law law = Law::corrected;
  ControlSettings control = {};
  bool steered_by_truth = false;  ///< instead of by the estimate
  bool starts_at_rest = false;    ///< instead of as the path goes
  double duration_s = 40, rate_hz = 20;

  int points = 30;
  int anchors = 0;             ///< of them, known beforehand
  bool given_commands = true;  ///< the filter is given the commands (Appendix B); else they are noise to it
  double sigma_unknown_input = 4;  ///< of the accelerations then, m/s^2 and rad/s^2, per axis and tick

  double sigma_pixel_px = 1;
  double sigma_acceleration_m_s2 = 0.3;  ///< disturbs the camera, per axis, held for a tick
  double sigma_angular_acceleration_rad_s2 = 0.3;
  double sigma_start_position_m = 0.01, sigma_start_angle_rad = 0.01;  ///< "very close to the real value"
  double sigma_start_velocity_m_s = 0.05, sigma_start_rate_rad_s = 0.05;
  double inverse_depth_per_m = 0.25;  ///< of a new landmark, give or take as much; the estimator's own
  double gate_probability = 0.999;

  double noise_times = 1;  ///< of all true noises and the start, the filter's left as they are
};

/// The setup's law, by the true or the estimated state.
std::unique_ptr<Steering> law_of(const Setup& setup);

/// Where the path starts, moving as it does unless it starts at rest.
FreeCameraMotion::State<double> start_of(const Setup& setup);

/// A. J. Davison's lens, as scenarios/davison.toml has it: 320x240 pixels, 97 degrees wide.
Camera lens();

using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Instant {
  double t = 0;
  Reference reference;
  FreeCameraMotion::State<double> truth, mean;
  Vector6 error;         ///< truth less estimate: position (m, world), rotation (rad, camera axes)
  Vector6 sigma;         ///< of it, by the filter
  Vector6 command;       ///< m/s^2, rad/s^2; held from now on
  double pose_nees = 0;  ///< over its 6 degrees of freedom
  double nis = 0;        ///< of this tick's measurements, over their number; 0 without any
  bool lost = false;

  /// Figure 5.13 (c)
  double estimated_off_m() const { return (mean.head<3>() - reference.position).norm(); }
  double truly_off_m() const { return (truth.head<3>() - reference.position).norm(); }
  double position_error_m() const { return error.head<3>().norm(); }
  double sigma_position_m() const { return sigma.head<3>().norm(); }
};

/// Angle between two orientations.
double angle_between_rad(const Eigen::Vector4d& a, const Eigen::Vector4d& b);

/// Angle between the orientation of a camera and its reference.
double gaze_off_rad(const FreeCameraMotion::State<double>& camera, const Reference& reference);

struct MappedPoint {
  Eigen::Vector3d estimated, truth;
  Eigen::Matrix3d covariance;
};

struct Course {
  std::vector<Instant> instants;
  std::vector<MappedPoint> map;  ///< at the end, anchors left out
  std::vector<Eigen::Vector3d> place;
};

/// The same seed has the same room, start, disturbances and pixel noise whatever the setup.
Course run(const Setup& setup, std::uint64_t seed);

}  // namespace incognita::swinging_camera
