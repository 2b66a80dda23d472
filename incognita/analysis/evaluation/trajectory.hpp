// How far an estimated trajectory is from the true one: association in time, alignment, ATE and RPE.
//
// Terms as the field uses them (Sturm et al. 2012; Zhang and Scaramuzza 2018): the absolute trajectory error
// is the distance between estimated and true positions after alignment, the relative pose error is the error
// of the motion made within a fixed time or number of poses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace incognita {

/// A pose world_from_body at a time.
struct StampedPose {
  double t = 0;                                               ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< world, m
  Eigen::Vector4d orientation = Eigen::Vector4d(1, 0, 0, 0);  ///< unit quaternion w,x,y,z
  bool oriented = true;  ///< else the orientation is not known, as that of GPS, and means nothing
};
using Trajectory = std::vector<StampedPose>;

/// Pairs of indices (estimate, truth), in time order: poses that are each other's nearest in time and at most
/// `max_dt_s` apart. No pose is in two pairs. Neither trajectory need be sorted.
std::vector<std::pair<std::size_t, std::size_t>> associate(const Trajectory& estimate,
                                                           const Trajectory& truth, double max_dt_s);

/// The poses of such pairs: two trajectories of equal length, in time order.
struct MatchedTrajectories {
  Trajectory estimate;
  Trajectory truth;
};
MatchedTrajectories match(const Trajectory& estimate, const Trajectory& truth, double max_dt_s);

enum class AlignmentKind {
  none,  ///< the estimate is in the true frame already
  se3,   ///< rotation and translation
  sim3,  ///< and scale: what one camera without a known target cannot know
  yaw,   ///< rotation about the vertical and translation: what gravity leaves free
};
const char* name(AlignmentKind kind);
/// Nothing for a word that is none of the four.
std::optional<AlignmentKind> alignment_kind(std::string_view word);

/// position_in_truth = scale * rotation * position + translation.
struct Alignment {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// The alignment with the least sum of squared distances between matched positions (Umeyama 1991 for se3 and
/// sim3). Nothing where the positions do not determine it: no poses, or a scale asked of a trajectory that
/// never moved. On a straight line the turn about that line is free; the errors of positions do not depend on
/// it.
std::optional<Alignment> align(const MatchedTrajectories& matched, AlignmentKind kind);

/// The estimate as it is after alignment.
Trajectory aligned(const Trajectory& estimate, const Alignment& alignment);

struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0, mean = 0, median = 0, max = 0;
};
ErrorStatistics statistics(std::vector<double> errors);

/// Distances between estimated and true positions; align first.
ErrorStatistics absolute_trajectory_error(const MatchedTrajectories& matched);

/// The interval of a relative pose error: a time, or a number of matched poses when `frames` is above 0.
struct RelativeInterval {
  double seconds = 1;
  int frames = 0;
};

struct RelativePoseError {
  ErrorStatistics translation_m;
  ErrorStatistics rotation_rad;
};

/// Errors of the relative motion between each pose and the one an interval later. For an interval in seconds
/// that is the pose nearest in time to it, and a pair whose interval is off by more than a tenth is left out.
/// Only the scale of an alignment matters here. Poses without orientation have no relative motion.
RelativePoseError relative_pose_error(const MatchedTrajectories& matched, const RelativeInterval& interval);

}  // namespace incognita
