// Camera measurement of a landmark by a free camera, and landmark initialization from a pixel.
//
// Two landmark parametrizations. A point (3 errors) is its position in the world. An inverse-depth landmark
// (6 errors; Montiel, Civera, Davison, RSS 2006) is the camera position at initialization, the direction from
// there and the inverse depth. Its measurement is nearly linear even when the depth is unknown. The direction
// is stored as (x, y, 1) in the constant axes of the initial camera, which avoids the poles of azimuth and
// elevation; depth is along the optical axis of that camera.
#pragma once

#include <optional>

#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/sensors/camera.hpp"

namespace incognita {

using CameraState = FreeCameraMotion::State<double>;

/// d(pixel) / d(error of a free camera); the velocity and rate columns are zero.
using CameraJacobian = Eigen::Matrix<double, 2, FreeCameraMotion::error_size>;

struct PointLandmark {
  static constexpr int size = 3;
  static constexpr Chart chart = Chart::line(size);
  using State = Eigen::Vector3d;

  struct Prediction {
    Eigen::Vector2d pixel;
    CameraJacobian Hv;               ///< d(pixel) / d(camera error)
    Eigen::Matrix<double, 2, 3> Hl;  ///< d(pixel) / d(landmark), px/m
  };

  /// The point in camera axes, m; independent of the projection model.
  template <class S>
  static Vector3<S> in_camera(const FreeCameraMotion::State<S>& camera, const Vector3<S>& point) {
    return rotation_matrix<S>(camera.template segment<4>(3)).transpose() *
           (point - camera.template segment<3>(0));
  }

  /// Nothing where the camera model is not defined; the pixel may lie outside the image.
  static std::optional<Prediction> predict_measurement(const Camera& camera, const CameraState& x,
                                                       const State& point);

  /// d(point) / d(turn of the world about its origin, rad, world axes).
  static Eigen::Matrix3d by_world_turn(const State& point);
};

struct InverseDepthLandmark {
  static constexpr int size = 6;
  static constexpr Chart chart = Chart::line(size);
  using State = Eigen::Matrix<double, 6, 1>;  ///< initial position (m), direction x, y, inverse depth (1/m)

  Eigen::Vector4d world_from_initial_camera{1, 0, 0, 0};  ///< axes of the initial camera, a constant

  struct Prediction {
    Eigen::Vector2d pixel;
    CameraJacobian Hv;
    Eigen::Matrix<double, 2, 6> Hl;
    /// d(pixel) / d(inverse depth * vector from the camera to the initial position), world axes: the measurement is
    /// bilinear in these two
    Eigen::Matrix<double, 2, 3> by_parallax;
  };
  struct Initialization {
    Eigen::Vector4d world_from_initial_camera;
    State landmark;
    Eigen::Matrix<double, 6, FreeCameraMotion::error_size> Jv;  ///< d(landmark) / d(camera error)
    Eigen::Matrix<double, 6, 2> Jz;                             ///< d(landmark) / d(pixel)
  };
  struct Point {
    Eigen::Vector3d position;
    Eigen::Matrix<double, 3, 6> J;
  };

  /// The landmark in camera axes, scaled by the inverse depth, so that it is finite at infinity.
  template <class S>
  Vector3<S> in_camera(const FreeCameraMotion::State<S>& camera, const Eigen::Matrix<S, 6, 1>& y) const {
    const Vector3<S> ray =
        rotation_matrix<S>(world_from_initial_camera.cast<S>()) * Vector3<S>(y[3], y[4], S(1));
    const Vector3<S> along = y[5] * (y.template head<3>() - camera.template segment<3>(0)) + ray;
    return rotation_matrix<S>(camera.template segment<4>(3)).transpose() * along;
  }

  std::optional<Prediction> predict_measurement(const Camera& camera, const CameraState& x,
                                                const State& y) const;

  /// Nothing when no ray maps to the pixel. `inverse_depth` (1/m): prior mean.
  static std::optional<Initialization> initialize(const Camera& camera, const CameraState& x,
                                                  const Eigen::Vector2d& pixel, double inverse_depth);

  /// d(landmark) / d(turn of the world about its origin, rad, world axes); the axes of the initial camera stay.
  Eigen::Matrix<double, 6, 3> by_world_turn(const State& y) const;

  /// Conversion to a point; requires a positive inverse depth.
  Point point(const State& y) const;

  /// Linearity index (Civera, Davison, Montiel, IEEE T-RO 2008, eq. 29): nonlinearity of the point's
  /// measurement over the spread of its depth; below about 0.1 the point parametrization is adequate.
  double linearity_index(const State& y, double inverse_depth_var,
                         const Eigen::Vector3d& camera_position) const;
};

}  // namespace incognita
