// A stereo pair of cameras with parallel axes, and its measurement of a point.
//
// Both cameras have the same projection model and orientation; the right one is offset by `baseline_m` along
// the x axis of the left one. The pose is that of the left camera. Measurement (3): column and row in the
// left image, column in the right image (px). Equal pixel noises are independent in these coordinates, unlike
// with the disparity z[0] - z[2]. The row in the right image is nearly redundant and is not used.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "incognita/models/sensors/camera.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

struct StereoCamera {
  Camera camera;  ///< projection model of both cameras
  double baseline_m = 0.11;
  double least_disparity_px = 0.5;  ///< no initialization below: 0.5 px of noise reaches infinity

  using Jacobian = Eigen::Matrix<double, 3, FreeCameraMotion::error_size>;

  struct Prediction {
    Eigen::Vector3d z;      ///< px: u and v in the left image, u in the right one
    Eigen::Vector2d right;  ///< px, the whole pixel in the right image
    Jacobian Hv;            ///< d(z) / d(camera error); velocity and rate columns are zero
    Eigen::Matrix3d Hl;     ///< d(z) / d(landmark), px/m
  };
  /// Prediction for an inverse-depth landmark, whose measurement is nearly linear at any distance, unlike
  /// that of a point.
  struct InverseDepthPrediction {
    Eigen::Vector3d z;
    Eigen::Vector2d right;
    Jacobian Hv;
    Eigen::Matrix<double, 3, 6> Hl;
  };
  struct InverseDepthInitialization {
    InverseDepthLandmark form;
    InverseDepthLandmark::State landmark;
    Eigen::Matrix<double, 6, FreeCameraMotion::error_size> Jv;
    Eigen::Matrix<double, 6, 3> Jz;
  };
  struct Initialization {
    Eigen::Vector3d landmark;                                   ///< m, world
    Eigen::Matrix<double, 3, FreeCameraMotion::error_size> Jv;  ///< d(landmark) / d(camera error)
    Eigen::Matrix3d Jz;                                         ///< d(landmark) / d(z)
  };

  /// Throws std::invalid_argument, naming the invalid parameter.
  void check() const;

  /// Nothing where one of the cameras is not defined, e.g. behind them; the pixels may lie outside the images.
  std::optional<Prediction> predict_measurement(const CameraState& left, const Eigen::Vector3d& point) const;

  std::optional<InverseDepthPrediction> predict_measurement(
      const CameraState& left, const InverseDepthLandmark& form,
      const InverseDepthLandmark::State& landmark) const;

  /// Whether the pixels are in both images, at least `margin` pixels from their borders.
  template <class SomePrediction>
  bool contains(const SomePrediction& prediction, double margin = 0) const {
    return camera.contains(prediction.z.template head<2>(), margin) &&
           camera.contains(prediction.right, margin);
  }

  /// Triangulation. Nothing when the disparity is too small or no ray maps to the pixels.
  std::optional<Initialization> initialize(const CameraState& left, const Eigen::Vector3d& z) const;

  /// The same point with inverse depth, whose error is nearly Gaussian given a disparity; that of the
  /// distance is not.
  std::optional<InverseDepthInitialization> initialize_inverse_depth(const CameraState& left,
                                                                     const Eigen::Vector3d& z) const;

 private:
  std::optional<double> inverse_depth(const Eigen::Vector3d& ray, double u_right) const;
};

}  // namespace incognita
