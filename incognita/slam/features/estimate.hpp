// All that is known: the belief, what each landmark is, and whether to trust it. Updated in place.
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

/// The appearance of a landmark and the view it was taken from.
struct PatchView {
  PatchTexture texture;
  Eigen::Vector2d pixel;            ///< in the image it was cut from, px
  Eigen::Vector3d camera_position;  ///< world, m
  Eigen::Vector4d world_from_camera;
  PatchPlane plane;
  double distance_m = 0;  ///< from camera to landmark then; 0 when the depth was not known
};

struct Landmark {
  enum class Kind {
    anchor,         ///< a known constant, not in the belief
    point,          ///< 3 errors
    inverse_depth,  ///< 6 errors
    line,           ///< 5 errors: an inverse-depth landmark whose depth is a set of hypotheses
  };
  /// One depth hypothesis on a line: inverse depth along the birth view's axis, and its probability.
  struct Particle {
    double inverse_depth = 0;
    double weight = 0;
  };

  std::int64_t id = 0;
  Kind kind = Kind::point;
  BlockId block = 0;                    ///< in the belief, unless an anchor
  Eigen::Vector3d anchor{0, 0, 0};      ///< world, m; anchors only
  InverseDepthLandmark initial_axes{};  ///< inverse depth and lines only
  std::vector<Particle> particles;      ///< lines only
  PatchView view;
  int attempts = 0;       ///< searches in frames that were otherwise matched
  int matches = 0;        ///< of them, how many updated the filter
  int frames_away = 0;    ///< since it last updated the filter, or was born
  int line_failures = 0;  ///< lines only: searches in a row that found nothing

  bool mapped() const { return kind == Kind::point || kind == Kind::inverse_depth; }
};

/// A landmark as it is expected in this frame, and what the search made of it.
struct FeatureMatch {
  std::size_t landmark = 0;  ///< index into the catalogue of this frame
  std::int64_t id = 0;
  Landmark::Kind kind = Landmark::Kind::point;
  Eigen::Vector2d predicted;       ///< px, from the belief before this image was used
  Eigen::Matrix2d innovation_cov;  ///< S_i = H_i P H_i' + R, px^2
  CameraJacobian Hv;
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 6> Hl;  ///< no columns for anchors
  Eigen::Vector3d point;              ///< world, m: where the landmark was taken to be for the warp
  Eigen::Matrix2d texture_from_view;  ///< local map of pixels of this view to pixels of the patch's texture
  std::optional<Eigen::Vector2d> measured;
  std::optional<PlaneEvidence> plane;                   ///< of a match on a plane that is not known
  Eigen::Matrix2d plane_cov = Eigen::Matrix2d::Zero();  ///< px^2: what that adds to the noise of the match
  double correlation = 0;
  MatchOutcome outcome = MatchOutcome::not_searched;
};

/// A line looked for along all its hypotheses of depth at once, after the camera has been corrected by the
/// map's looks. It corrects no camera: `matched` re-weights the hypotheses, `inconsistent` means that none
/// explains what was found.
struct LineMatch {
  std::int64_t id = 0;
  Eigen::Vector2d predicted;       ///< px, mean over the hypotheses in view, by weight
  Eigen::Matrix2d innovation_cov;  ///< px^2, about that mean: their own and how far they are apart
  std::optional<Eigen::Vector2d> measured;
  double correlation = 0;
  MatchOutcome outcome = MatchOutcome::not_searched;
};

struct Estimate {
  Belief belief{256};
  BlockId camera = 0;
  bool started = false;  ///< whether `belief` holds a camera at all
  std::vector<Landmark> catalog;
  std::int64_t next_id = 0;
  TrackingStatus status;
  std::optional<double> first_t;    ///< s, of the first tick: when the search for the target began
  std::optional<double> entropy_t;  ///< s, when the entropy of the whole was last worked out

  // Of the last frame
  std::vector<FeatureMatch> matches;
  std::vector<LineMatch> line_matches;
  int predicted = 0;  ///< looks searched for
  int matched = 0;    ///< looks that updated the filter
  int visible = 0;    ///< landmarks expected in view
  UpdateReport update;
  Entropy entropy;
  std::vector<std::pair<const char*, double>> timing_ms;

  CameraState camera_state() const { return belief.mean(camera); }
  /// Landmarks in the map: points and inverse-depth landmarks, not anchors and not lines.
  int mapped_count() const {
    int count = 0;
    for (const Landmark& landmark : catalog) count += landmark.mapped();
    return count;
  }
};

/// Position in the world of a landmark and its covariance (zero for anchors); for a line, at its mean depth.
/// Nothing for an inverse depth that is not positive: the landmark may be at infinity.
struct LandmarkPosition {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;
};
std::optional<LandmarkPosition> position_of(const Landmark& landmark, const Belief& belief);

}  // namespace incognita
