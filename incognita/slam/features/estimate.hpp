// The estimate of single-camera SLAM: belief, landmarks and tracking status. Updated in place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/models/camera_measurement.hpp"
#include "incognita/slam/features/patch_plane.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"
#include "incognita/slam/mapper/status.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

/// The texture of a landmark and the view it was taken from.
struct PatchView {
  PatchTexture texture;
  Eigen::Vector2d pixel;            ///< in that view's image, px
  Eigen::Vector3d camera_position;  ///< world, m
  Eigen::Vector4d world_from_camera;
  PatchPlane plane;
  double distance_m = 0;  ///< from camera to landmark; 0 when the depth is unknown
};

struct Landmark {
  enum class Kind {
    anchor,         ///< at a known position, not in the belief
    point,          ///< 3 errors
    inverse_depth,  ///< 6 errors
    line,           ///< 5 errors: an inverse-depth landmark whose depth is a set of hypotheses
  };
  /// A depth hypothesis on a line: inverse depth along the initial optical axis, and its probability.
  struct Particle {
    double inverse_depth = 0;
    double weight = 0;
  };

  std::int64_t id = 0;
  Kind kind = Kind::point;
  BlockId block = 0;                    ///< in the belief, except for anchors
  Eigen::Vector3d anchor{0, 0, 0};      ///< world, m; anchors only
  InverseDepthLandmark initial_axes{};  ///< inverse depth and lines only
  std::vector<Particle> particles;      ///< lines only
  PatchView view;
  int attempts = 0;       ///< searches in frames that were otherwise matched
  int matches = 0;        ///< number of them that updated the filter
  int frames_away = 0;    ///< since its last update of the filter or its initialization
  int line_failures = 0;  ///< lines only: consecutive failed searches

  bool mapped() const { return kind == Kind::point || kind == Kind::inverse_depth; }
};

/// The predicted measurement of a landmark in this frame, and the result of the search.
struct FeatureMatch {
  std::size_t landmark = 0;  ///< index into the catalog of this frame
  std::int64_t id = 0;
  Landmark::Kind kind = Landmark::Kind::point;
  Eigen::Vector2d predicted;       ///< px, from the prior belief
  Eigen::Matrix2d innovation_cov;  ///< S_i = H_i P H_i' + R, px^2
  CameraJacobian Hv;
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 6> Hl;  ///< no columns for anchors
  Eigen::Vector3d point;                                 ///< world, m: position assumed for the warp
  Eigen::Matrix2d texture_from_view;  ///< local map from pixels of this view to pixels of the texture
  std::optional<Eigen::Vector2d> measured;
  std::optional<PlaneEvidence> plane;                   ///< of a match on a patch of unknown plane
  Eigen::Matrix2d plane_cov = Eigen::Matrix2d::Zero();  ///< px^2: its additional noise
  double correlation = 0;
  MatchOutcome outcome = MatchOutcome::not_searched;
};

/// The search for a line along all its depth hypotheses, after the camera has been updated by the map's
/// features. It does not update the camera: `matched` re-weights the hypotheses; `outlier` means that no
/// hypothesis explains the match.
struct LineMatch {
  std::int64_t id = 0;
  Eigen::Vector2d predicted;       ///< px, weighted mean of the hypotheses in view
  Eigen::Matrix2d innovation_cov;  ///< px^2, about that mean: of the mixture of the hypotheses
  std::optional<Eigen::Vector2d> measured;
  double correlation = 0;
  MatchOutcome outcome = MatchOutcome::not_searched;
};

struct Estimate {
  Belief belief{256};
  BlockId camera = 0;
  bool started = false;  ///< whether `belief` contains the camera
  std::vector<Landmark> catalog;
  std::int64_t next_id = 0;
  TrackingStatus status;
  std::optional<double> first_t;    ///< s, of the first tick: start of the search for the target
  std::optional<double> entropy_t;  ///< s, of the last refresh of the total entropy

  // Results of the last frame
  std::vector<FeatureMatch> matches;
  std::vector<LineMatch> line_matches;
  int predicted = 0;  ///< features searched for
  int matched = 0;    ///< features that updated the filter
  int visible = 0;    ///< landmarks predicted in view
  UpdateReport update;
  Entropy entropy;
  std::vector<std::pair<const char*, double>> timing_ms;

  CameraState camera_state() const { return belief.mean(camera); }
  /// Number of points and inverse-depth landmarks, without anchors and lines.
  int mapped_count() const {
    int count = 0;
    for (const Landmark& landmark : catalog) count += landmark.mapped();
    return count;
  }
};

/// World position of a landmark and its covariance (zero for anchors); for a line, at its mean depth. Nothing
/// unless the inverse depth is positive: the landmark may be at infinity.
struct LandmarkPosition {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;
};
std::optional<LandmarkPosition> position_of(const Landmark& landmark, const Belief& belief);

}  // namespace incognita
