// Error of an estimated trajectory: association in time, alignment, ATE and RPE.
//
// Terms as in Sturm et al. 2012 and Zhang and Scaramuzza 2018: the absolute trajectory error (ATE) is the
// distance between estimated and true positions after alignment; the relative pose error (RPE) is the error
// of the motion within a fixed time or number of poses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace incognita {

/// Time-stamped pose world_from_body.
struct StampedPose {
  double t = 0;                                               ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< world, m
  Eigen::Vector4d orientation = Eigen::Vector4d(1, 0, 0, 0);  ///< unit quaternion w,x,y,z
  bool oriented = true;  ///< false: the orientation is unknown, as with GPS, and must not be used
};
using Trajectory = std::vector<StampedPose>;

/// Pairs of indices (estimate, truth), in time order: mutually nearest poses in time, at most `max_dt_s`
/// apart. No pose is in two pairs. The trajectories need not be sorted.
std::vector<std::pair<std::size_t, std::size_t>> associate(const Trajectory& estimate,
                                                           const Trajectory& truth, double max_dt_s);

/// Matched poses: two trajectories of equal length, in time order.
struct MatchedTrajectories {
  Trajectory estimate;
  Trajectory truth;
};
MatchedTrajectories match(const Trajectory& estimate, const Trajectory& truth, double max_dt_s);

enum class AlignmentKind {
  none,  ///< the estimate is already in the true frame
  se3,   ///< rotation and translation
  sim3,  ///< and scale, which one camera without a known target cannot observe
  yaw,   ///< rotation about the vertical and translation, unobservable with gravity known
};
const char* name(AlignmentKind kind);
/// Parses a name; empty if it is none of the four.
std::optional<AlignmentKind> alignment_kind(std::string_view word);

/// position_in_truth = scale * rotation * position + translation.
struct Alignment {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Alignment with the least sum of squared distances between matched positions (Umeyama 1991 for se3 and
/// sim3). Empty if the positions do not determine it: no poses, or the scale of a trajectory without motion.
/// On a straight line the rotation about it is free; position errors do not depend on it.
std::optional<Alignment> align(const MatchedTrajectories& matched, AlignmentKind kind);

/// The estimate after alignment.
Trajectory aligned(const Trajectory& estimate, const Alignment& alignment);

struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0, mean = 0, median = 0, max = 0;
};
ErrorStatistics statistics(std::vector<double> errors);

/// Distances between estimated and true positions; align first.
ErrorStatistics absolute_trajectory_error(const MatchedTrajectories& matched);

/// Interval of a relative pose error: a time, or a number of matched poses if `frames` is above 0.
struct RelativeInterval {
  double seconds = 1;
  int frames = 0;
};

struct RelativePoseError {
  ErrorStatistics translation_m;
  ErrorStatistics rotation_rad;
};

/// Errors of the relative motion between each pose and the one an interval later. For an interval in seconds
/// this is the pose nearest in time; pairs whose interval is off by more than a tenth are skipped. Of an
/// alignment only the scale matters. Poses without orientation are skipped.
RelativePoseError relative_pose_error(const MatchedTrajectories& matched, const RelativeInterval& interval);

}  // namespace incognita
