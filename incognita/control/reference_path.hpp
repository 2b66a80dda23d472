// Paths in time: where to be, how fast, and where to look, at every moment. The world is z-up; t is in
// seconds from the start of the path, for samples on their own clock.
//
// Before its start and from its end on a path stands still, there where it starts or ends.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "incognita/control/path_samples.hpp"
#include "incognita/control/pose_spline.hpp"
#include "incognita/control/reference.hpp"
#include "incognita/math/angles.hpp"

namespace incognita {

/// Stay there: for regulation.
struct PointPath {
  Eigen::Vector3d position{0, 0, 0};
  double heading_rad = 0;
};

/// Round a circle at a steady rate, thesis (5.14). (5.15) is meant as its velocity and lacks the factor
/// `rate_rad_s`. The heading is the direction of travel.
struct CirclePath {
  Eigen::Vector3d center{0, 0, 0};
  double radius_m = 7;
  double rate_rad_s = radians(5);  ///< positive to the left; not 0
  double phase_rad = 0;            ///< where on the circle it starts
};

/// Back and forth on a circle, always looking at its centre: thesis (5.28), with p = amplitude (sin 2t -
/// 2t/pi).
///
/// The thesis' axes are x left, y up, z forward: position (r sin p, 0, -r cos p), and a turn by p about y
/// that takes world to camera, which makes its optical axis (-sin p, 0, cos p), towards the centre. Its (x,
/// y, z) are (y, z, x) here: position r (-cos p, sin p, 0), heading -p. The thesis' constant w_y* is not a
/// rate but the amplitude of the angle; the rate is amplitude (2 cos 2t - 2/pi). It is not periodic: every pi
/// seconds it comes back 2 amplitudes short.
struct BackAndForthPath {
  Eigen::Vector3d center{0, 0, 0};
  double radius_m = 1.5;
  double amplitude_rad = radians(15);
};

/// Straight from each way-point to the next with the least jerk, at rest at each. Whoever sets way-points
/// expects the straight line between them, around whatever they were set to avoid; a smooth curve through
/// them leaves it. The heading is that of the leg, and changes at once where the vehicle stands.
struct WayPointPath {
  std::vector<Eigen::Vector3d> points;
  double speed_m_s = 0.5;  ///< the highest, midway; the mean is 8/15 of it
};

/// Through samples with continuous velocity and acceleration. Made by `through`.
struct SampledPath {
  PoseSpline spline;
};

using Path = std::variant<PointPath, CirclePath, BackAndForthPath, WayPointPath, SampledPath>;

/// Without headings the path looks along its direction of travel at each sample, and turns smoothly between.
/// Headings take the shorter way round from each to the next. Throws std::invalid_argument for samples that
/// do not fit each other or do not follow each other in time.
SampledPath through(const PathSamples& samples);

/// Throws std::invalid_argument with the reason where the path is none: a radius that is not positive, no
/// way-points, numbers that are not finite.
void check(const Path& path);

/// Of a path that was checked.
Reference at(const Path& path, double t);

struct PathSpan {
  double start_s = 0;
  double end_s = 0;  ///< infinite where the path does not end
};

PathSpan span_of(const Path& path);

}  // namespace incognita
