// What a free camera sees of a landmark, and how a landmark is born from a pixel.
//
// Two landmark models. A point (3 errors) is its position in the world. An inverse-depth landmark (6 errors;
// Montiel, Civera, Davison, RSS 2006) is where it was first seen from, the direction it was seen in, and one
// over its depth: its looks are nearly linear while the depth is not known. The direction is kept as (x, y,
// 1) in the axes of the birth view, which are a constant, so that there is no pole as there is with azimuth
// and elevation, and the depth is along the birth view's optical axis.
#pragma once

#include <optional>

#include "incognita/models/camera.hpp"
#include "incognita/models/free_camera.hpp"

namespace incognita {

using CameraState = FreeCameraMotion::State<double>;

/// Jacobian of a pixel with respect to the error of a free camera (velocity and rate columns are zero).
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

  /// The point in camera axes, m: the part of the model that does not depend on which camera looks.
  template <class S>
  static Vector3<S> in_camera(const FreeCameraMotion::State<S>& camera, const Vector3<S>& point) {
    return rotation_matrix<S>(camera.template segment<4>(3)).transpose() *
           (point - camera.template segment<3>(0));
  }

  /// Nothing where the camera model is not defined; the pixel may lie outside the image.
  static std::optional<Prediction> predict_measurement(const Camera& camera, const CameraState& x,
                                                       const State& point);
};

struct InverseDepthLandmark {
  static constexpr int size = 6;
  static constexpr Chart chart = Chart::line(size);
  using State = Eigen::Matrix<double, 6, 1>;  ///< birth position (m), direction x and y, inverse depth (1/m)

  Eigen::Vector4d world_from_initial_camera{1, 0, 0, 0};  ///< axes of the view of birth, a constant

  struct Prediction {
    Eigen::Vector2d pixel;
    CameraJacobian Hv;
    Eigen::Matrix<double, 2, 6> Hl;
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

  /// A vector along the landmark in camera axes; its length means nothing, so infinity is as good as any
  /// place.
  template <class S>
  Vector3<S> in_camera(const FreeCameraMotion::State<S>& camera, const Eigen::Matrix<S, 6, 1>& y) const {
    const Vector3<S> ray =
        rotation_matrix<S>(world_from_initial_camera.cast<S>()) * Vector3<S>(y[3], y[4], S(1));
    const Vector3<S> along = y[5] * (y.template head<3>() - camera.template segment<3>(0)) + ray;
    return rotation_matrix<S>(camera.template segment<4>(3)).transpose() * along;
  }

  std::optional<Prediction> predict_measurement(const Camera& camera, const CameraState& x,
                                                const State& y) const;

  /// Nothing where no ray reaches the pixel. `inverse_depth` (1/m) is the mean before anything is known.
  static std::optional<Initialization> initialize(const Camera& camera, const CameraState& x,
                                                  const Eigen::Vector2d& pixel, double inverse_depth);

  /// The same landmark as a point; needs a positive inverse depth.
  Point point(const State& y) const;

  /// Civera's linearity index: how far from linear the look of the equivalent point would be over the depth's
  /// spread (Civera, Davison, Montiel, IEEE T-RO 2008, eq. 29); below about 0.1 a point is as good.
  double linearity_index(const State& y, double inverse_depth_var,
                         const Eigen::Vector3d& camera_position) const;
};

}  // namespace incognita
