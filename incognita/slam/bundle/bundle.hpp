// Camera poses and landmarks with the image positions that connect them: what bundle adjustment estimates (Triggs et al.,
// "Bundle adjustment, a modern synthesis", 1999). Landmarks are parametrized as in the belief, so that the estimate
// and its covariance can be taken over by it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

/// The pose of a camera at one time. Its error: position, right rotation error (6).
struct BundleView {
  Eigen::Vector3d position{0, 0, 0};              ///< world, m
  Eigen::Vector4d world_from_camera{1, 0, 0, 0};  ///< unit quaternion w, x, y, z
  bool fixed = false;                             ///< known, not estimated
};

inline BundleView view_of(const CameraState& camera) { return {camera.head<3>(), camera.segment<4>(3)}; }

/// A landmark (3 errors).
struct BundlePoint {
  enum class Kind {
    fixed,          ///< at a known position, not estimated
    point,          ///< position in the world, m
    inverse_depth,  ///< direction x, y in `initial_axes` from the position of view `host`, inverse depth, 1/m
  };
  Kind kind = Kind::point;
  Eigen::Vector3d value{0, 0, 0};
  Eigen::Vector4d initial_axes{1, 0, 0, 0};  ///< inverse depth only
  int host = -1;                             ///< inverse depth only
  /// Prior of the inverse depth, 1/m; an infinite sigma: none.
  double prior_inverse_depth = 0, sigma_prior_inverse_depth = 0;
};

struct BundleObservation {
  int view = 0, point = 0;
  Eigen::Vector2d pixel{0, 0};
  Eigen::Matrix2d cov = Eigen::Matrix2d::Identity();  ///< px^2
};

struct Bundle {
  std::vector<BundleView> views;
  std::vector<BundlePoint> points;
  std::vector<BundleObservation> observations;  ///< in the order of their points
  /// Gaussian prior of the first view, unless that is fixed: it gives the frame of the world.
  BundleView first_view;
  Eigen::Matrix<double, 6, 6> first_view_cov = Eigen::Matrix<double, 6, 6>::Identity();
};

}  // namespace incognita
