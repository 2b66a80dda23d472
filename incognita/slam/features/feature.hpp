// The image front end's knowledge of a camera: the appearance of its landmarks, keyed by landmark id, and the
// results of the current frame. What is estimated is in slam/mapper/estimate.hpp.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "incognita/models/motion/mount.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/slam/bundle/depth_prior.hpp"
#include "incognita/slam/features/lasting_errors.hpp"
#include "incognita/slam/features/patch_plane.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/slam/mapper/depth_hypotheses.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/vision/descriptor.hpp"
#include "incognita/vision/patch.hpp"
#include "incognita/vision/pyramid.hpp"

namespace incognita {

/// The texture of a landmark and the view it was taken from.
struct PatchView {
  PatchTexture texture;
  std::vector<PatchTexture>
      coarse;             ///< the same at levels 1, 2, ... of the image pyramid, as far as they lie in it
  Eigen::Vector2d pixel;  ///< in that view's image, px
  Eigen::Vector3d camera_position;  ///< world, m
  Eigen::Vector4d world_from_camera;
  PatchPlane plane;
};

/// A view under which a landmark was matched, described for relocalization: recognition.hpp.
struct DescribedView {
  Eigen::Vector3d camera_position;  ///< world, m
  Eigen::Vector4d world_from_camera;
  Eigen::Vector2d pixel;  ///< px
  struct AtScale {
    double scale = 1;  ///< side of the described square, in units of described_px
    Descriptor descriptor;
  };
  std::vector<AtScale> descriptors;  ///< one or more per scale
};

/// The appearance of one landmark.
struct Feature {
  PatchView view;
  std::vector<DescribedView>
      described;  ///< empty: not recognized by a lost camera, only where it is predicted
  std::vector<DepthHypothesis> depths;  ///< of a ray only
  int attempts = 0;                     ///< searches in frames that were otherwise matched
  /// Searches and matches weighted by age, with a time constant of MapSettings::memory_attempts; without it unused.
  double recent_attempts = 0, recent_matches = 0;
  int ray_failures = 0;  ///< of a ray only: consecutive failed searches
  int frames_known = 0;  ///< since its initialization
  int frames_away = 0;   ///< since its last update of the filter or its initialization
  int frames_in_view = 0,
      frames_out_of_view = 0;  ///< where the filter predicted it, of the last visit and since then

  /// Since it came into the predicted view, before this frame.
  int frames_since_return() const { return frames_out_of_view > 0 ? 0 : frames_in_view; }
};

/// The predicted measurement of a landmark in this frame, and the result of the search.
struct FeatureMatch {
  std::int64_t id = 0;
  bool anchor = false;
  Eigen::Vector2d predicted;                                 ///< px, from the prior belief
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Zero();  ///< S_i = H_i P H_i' + R, px^2
  /// px^2, of the error of a match, white and lasting, before it
  Eigen::Matrix2d error_cov = Eigen::Matrix2d::Zero();
  double expected_information = 0;                       ///< nats, of a search; it orders them
  bool comes_first = false;                              ///< is searched for before all others
  CameraJacobian Hv;                                     ///< d(pixel) / d(camera error)
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 6> Hl;  ///< no columns for anchors
  /// InverseDepthLandmark::Prediction; zero for points
  Eigen::Matrix<double, 2, 3> by_parallax = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix2d second_order_cov = Eigen::Matrix2d::Zero();  ///< px^2: what the linearization leaves out
  Eigen::Vector3d point;                                       ///< world, m: position assumed for the warp
  Eigen::Matrix2d texture_from_view =
      Eigen::Matrix2d::Identity();  ///< local map from pixels of this view to pixels of the texture
  std::optional<Eigen::Vector2d> measured;
  int level = 0;  ///< of the pyramid, at which it was found: its noise is 2^level times as large
  std::optional<PlaneEvidence> plane;                   ///< of a match on a patch of unknown plane
  Eigen::Matrix2d plane_cov = Eigen::Matrix2d::Zero();  ///< px^2: its additional noise
  double correlation = 0;
  MatchOutcome outcome = MatchOutcome::not_searched;
};

/// The search for a ray along all its depth hypotheses, after the camera has been updated by the map's
/// features. It does not update the camera: `matched` re-weights the hypotheses; `outlier` means that no
/// hypothesis explains the match.
struct RayMatch {
  std::int64_t id = 0;
  Eigen::Vector2d predicted;       ///< px, weighted mean of the hypotheses in view
  Eigen::Matrix2d innovation_cov;  ///< px^2, about that mean: of the mixture of the hypotheses
  std::optional<Eigen::Vector2d> measured;
  double correlation = 0;
  MatchOutcome outcome = MatchOutcome::not_searched;
  int first_particle = 0, particle_count = 0;  ///< the hypotheses in view, in TrackedCamera::ray_particles
};

/// Pose of a camera, from the estimate of the body that carries it.
struct Viewpoint {
  BlockId body = 0;
  /// Velocity and rate are zero unless the body is the camera itself.
  CameraState camera = CameraState::Zero();
  SmallMatrix by_body;  ///< d(camera pose error, 6) / d(body error); empty: the body is the camera itself

  /// Jacobian by the body error, from that by the camera error.
  MeasurementJacobian jacobian(const CameraJacobian& by_camera) const;
};

/// A camera on a body, as the image front end tracks with it.
struct TrackedCamera {
  Camera camera;
  CameraSlamSettings settings = {};
  int index = 0;                    ///< among all cameras of the estimator; Landmark::camera
  std::size_t body = 0;             ///< that carries it
  std::optional<Mount> mount = {};  ///< none: the body is the camera itself
  std::map<std::int64_t, Feature> features = {};

  // Of the current frame
  Viewpoint view = {};
  /// Rotation of rays from where the filter predicts them to where the alignment of whole images does; none: no alignment
  std::optional<Eigen::Matrix3d> guide = {};
  std::vector<FeatureMatch> matches = {};
  std::vector<RayMatch> ray_matches = {};
  std::vector<DepthParticle> ray_particles = {};  ///< of those, one after the other
  double median_depth_m = 1;  ///< depth_of_view of the last matches, or that of a new landmark
  /// Prior of the inverse depth of a new landmark. That of the settings may lie far from all depths in view, and the error is
  /// common to all new landmarks: if these are a wall at 0.5 m that is expected at 2 m, translation looks like rotation; if they
  /// are walls at 4 m, hundreds of them make translation, and with it the map, too small.
  DepthPrior depth_prior() const;
  int max_measurements = 0;  ///< without SearchSettings::max_measurements
  int predicted = 0;         ///< features searched for
  int matched = 0;           ///< inliers

  /// Features that are searched for at most.
  int most_measurements() const {
    return settings.search.max_measurements > 0 ? settings.search.max_measurements : max_measurements;
  }
  double lasting_factor = 1;  ///< of the variance of a match in the correction: its error lasts, PixelNoise
  std::optional<double> sigma_pixel_px = {};  ///< as estimated from the matches; none: as in the settings
  /// px^2: of the white part of the error of a match, and of all of it.
  double pixel_var() const { return std::pow(sigma_pixel_px.value_or(settings.filter.sigma_pixel_px), 2); }
  double error_var() const { return pixel_var() + std::pow(settings.filter.sigma_lasting_px, 2); }
  LastingErrors lasting = {};
};

/// The pose of a camera on a body in `state`. `mount`: none if the body is the camera itself.
Viewpoint viewpoint_of(const SmallVector& state, const AnyMotion& motion, const std::optional<Mount>& mount,
                       BlockId body);
/// The pose of the camera at the current mean of its body.
Viewpoint viewpoint(const Estimate& estimate, const TrackedCamera& camera, const AnyMotion& motion);
/// The same of a body that is the camera itself.
Viewpoint viewpoint(const Estimate& estimate, const TrackedCamera& camera);

/// World position of a landmark, of a ray at its mean depth; nothing at infinity.
std::optional<Eigen::Vector3d> current_position(const Estimate& estimate, const Landmark& landmark,
                                                const Feature& feature);

/// Median distance in m of the landmarks matched in this frame; nothing without any. Where the prior of the depth is scaled to it
/// (`always`), only anchors and points count, whose depth is known: new landmarks would keep their own prior where it is.
std::optional<double> depth_of_view(const Estimate& estimate, const TrackedCamera& camera);

}  // namespace incognita
