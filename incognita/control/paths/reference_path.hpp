// Paths in time: position, velocity and heading at every moment. The world is z-up; t is in seconds from the
// start of the path; sampled paths use their own clock.
//
// Before its start a path stands at its first pose, after its end at its last.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "incognita/control/paths/path_samples.hpp"
#include "incognita/control/paths/pose_spline.hpp"
#include "incognita/control/paths/reference.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/math/setting.hpp"

namespace incognita {

/// A fixed point, for regulation.
struct PointPath {
  Eigen::Vector3d position{0, 0, 0};
  double heading_rad = 0;

  static void describe(auto&& setting) {
    setting(&PointPath::position, "position_m", "m", limits::between(-1e6, 1e6), "Position of the point");
    setting(&PointPath::heading_rad, "heading_rad", "rad", limits::between(-6.3, 6.3),
            "Heading at the point");
  }
};

/// Circle at a constant rate, thesis (5.14). (5.15) is meant as its velocity and lacks the factor
/// `rate_rad_s`. The heading is the direction of travel.
struct CirclePath {
  Eigen::Vector3d center{0, 0, 0};
  double radius_m = 7;
  double rate_rad_s = radians(5);
  double phase_rad = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = CirclePath;
    setting(&S::center, "center_m", "m", between(-1e6, 1e6), "Center of the circle");
    setting(&S::radius_m, "radius_m", "m", above_up_to(0, 1e6), "Radius of the circle");
    setting(&S::rate_rad_s, "rate_rad_s", "rad/s", between(-10, 10),
            "Angular rate around the center, positive to the left; not 0");
    setting(&S::phase_rad, "phase_rad", "rad", between(-6.3, 6.3), "Initial angle on the circle");
  }
};

/// Back and forth on a circle, always facing its center: thesis (5.28), with p = amplitude (sin 2t - 2t/pi).
///
/// The thesis' axes are x left, y up, z forward: position (r sin p, 0, -r cos p), and a rotation by p about y
/// from world to camera, so that the optical axis is (-sin p, 0, cos p), towards the center. Its (x, y, z)
/// are (y, z, x) here: position r (-cos p, sin p, 0), heading -p. The thesis' constant w_y* is not a rate but
/// the amplitude of the angle; the rate is amplitude (2 cos 2t - 2/pi). The path is not periodic: every pi
/// seconds it falls 2 amplitudes short.
struct BackAndForthPath {
  Eigen::Vector3d center{0, 0, 0};
  double radius_m = 1.5;
  double amplitude_rad = radians(15);

  static void describe(auto&& setting) {
    using namespace limits;
    using S = BackAndForthPath;
    setting(&S::center, "center_m", "m", between(-1e6, 1e6), "Center of the circle");
    setting(&S::radius_m, "radius_m", "m", above_up_to(0, 1e6), "Radius of the circle");
    setting(&S::amplitude_rad, "amplitude_rad", "rad", between(-3.2, 3.2), "Amplitude of (5.28)");
  }
};

/// Straight minimum-jerk legs between way-points, at rest at each. Way-points are set to avoid obstacles
/// along straight lines; a smooth curve through them would leave those lines. The heading is that of the leg
/// and steps at the way-points, at standstill.
struct WayPointPath {
  std::vector<Eigen::Vector3d> points;
  double speed_m_s = 0.5;

  static void describe(auto&& setting) {
    using namespace limits;
    setting(&WayPointPath::points, "points_m", "m", between(-1e6, 1e6), "Way-points, [x, y, z] each");
    setting(&WayPointPath::speed_m_s, "speed_m_s", "m/s", above_up_to(0, 1000),
            "Largest speed, at mid-leg; the mean is 8/15 of it");
  }
};

/// Path through samples with continuous velocity and acceleration; made by `through`.
struct SampledPath {
  PoseSpline spline;
};

using Path = std::variant<PointPath, CirclePath, BackAndForthPath, WayPointPath, SampledPath>;

/// Without headings the path faces its direction of travel at each sample and interpolates in between.
/// Headings are unwrapped along the shorter way. Throws std::invalid_argument if the sizes differ or the
/// times are not strictly increasing.
SampledPath through(const PathSamples& samples);

/// Throws std::invalid_argument for an invalid path: radius not positive, no way-points, numbers that are not
/// finite. The message states the reason.
void check(const Path& path);

/// Reference at time t, s. Requires a path that passed check().
Reference at(const Path& path, double t);

struct PathSpan {
  double start_s = 0;
  double end_s = 0;  ///< infinite for a path without end
};

PathSpan span_of(const Path& path);

}  // namespace incognita
