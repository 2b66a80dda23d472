// Camera poses that explain matches between an image and the map, most of which may be false: P3P in RANSAC (M. Fischler,
// R. Bolles 1981; T. Ke, S. Roumeliotis, CVPR 2017), and the pose of a set of matches by least squares.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

using PoseCov = Eigen::Matrix<double, 6, 6>;  ///< of position, m, and right rotation error, rad

/// A landmark that may be seen at a pixel.
struct PointMatch {
  std::int64_t id = 0;
  Eigen::Vector3d point{0, 0, 0};                 ///< world, m
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();  ///< m^2
  Eigen::Vector2d pixel{0, 0};
  Eigen::Vector3d first_view{0, 0, 0};  ///< camera position from which it can be recognized, world, m
  /// No other pixel looks like this landmark, and no other landmark like this pixel.
  bool is_distinctive = false;
  /// The pose of the camera from a single match: by the orientation and the scale of the patch. Nothing:
  /// any. Wrong by the change of the viewing direction.
  std::optional<CameraState> expected = {};
};

struct PoseLimits {
  double tolerance_px = 3;          ///< of a reprojected landmark, besides 2 sigma of its position
  double max_view_angle_rad = 0.8;  ///< of a viewing direction to that of the first view
  double max_scale = 2;             ///< of a distance to that of the first view, either way
  double max_turn_rad = 0.9;        ///< of the camera from the expected one of a match
  int min_matches = 4;              ///< of different landmarks and pixels
  int samples = 400;                ///< of three matches
  int max_hypotheses = 8;
};

struct PoseHypothesis {
  CameraState camera;  ///< at rest
  PoseCov cov;
  std::vector<int> matches;  ///< indices of those that it explains, each landmark and each pixel once
  int distinctive = 0;       ///< number of those that are distinctive
  double cost = 0;           ///< sum of their squared normalized errors
};

/// The poses that explain the most of `matches`, which are in the order of likeness, the most alike first: samples are drawn from
/// the first ones more often. The pose with the most comes first; none when all explain fewer than `min_matches`.
/// Poses that share most of their matches with a better one are left out. Deterministic for a state of `random`.
std::vector<PoseHypothesis> find_poses(const std::vector<PointMatch>& matches, const Camera& camera,
                                       const PoseLimits& limits, double sigma_pixel_px, RandomStream& random);

/// The pose that minimizes the reprojection errors of these matches, normalized by pixel noise and the covariances of
/// the landmarks, taken as independent; its covariance. `start` is near it. Nothing when a landmark leaves the domain of
/// the camera model, or the matches do not determine a pose.
struct RefinedPose {
  CameraState camera;
  PoseCov cov;
  double cost = 0;
};
std::optional<RefinedPose> refine_pose(const std::vector<PointMatch>& matches, const std::vector<int>& used,
                                       const Camera& camera, const CameraState& start, double sigma_pixel_px);

}  // namespace incognita
