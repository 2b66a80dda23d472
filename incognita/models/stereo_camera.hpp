// Two cameras side by side, and what they tell of a point.
//
// Both look the same way through lenses of the same kind; the right one sits `baseline_m` along the left
// one's x axis. The pose is the left one's. Measurement (3): column and row in the left image, column in the
// right one (px), so that three equal pixel noises are independent, as they are not of a disparity: that is
// z[0] - z[2]. The row in the right image says nearly what the row in the left one does and is not used.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "incognita/models/camera.hpp"
#include "incognita/models/camera_measurement.hpp"

namespace incognita {

struct StereoCamera {
  Camera camera;  ///< the lens of both
  double baseline_m = 0.11;
  double least_disparity_px =
      0.5;  ///< with less a point is born nowhere: half a pixel of noise reaches infinity

  using Jacobian = Eigen::Matrix<double, 3, FreeCameraMotion::error_size>;

  struct Prediction {
    Eigen::Vector3d z;      ///< px: u and v in the left image, u in the right one
    Eigen::Vector2d right;  ///< px, the whole pixel in the right image
    Jacobian Hv;            ///< d(z) / d(camera error); velocity and rate columns are zero
    Eigen::Matrix3d Hl;     ///< d(z) / d(landmark), px/m
  };
  /// Of an inverse-depth landmark: its looks are nearly linear however far it is, as those of a point are
  /// not.
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

  /// Throws std::invalid_argument naming the parameter that cannot be.
  void check() const;

  /// Nothing where either camera is not defined, as behind them; the pixels may lie outside the images.
  std::optional<Prediction> predict_measurement(const CameraState& left, const Eigen::Vector3d& point) const;

  std::optional<InverseDepthPrediction> predict_measurement(
      const CameraState& left, const InverseDepthLandmark& form,
      const InverseDepthLandmark::State& landmark) const;

  /// Whether both cameras have it in their images, at least `margin` pixels from the edge.
  template <class SomePrediction>
  bool contains(const SomePrediction& prediction, double margin = 0) const {
    return camera.contains(prediction.z.template head<2>(), margin) &&
           camera.contains(prediction.right, margin);
  }

  /// Where the rays meet. Nothing where the disparity is too small, or no ray reaches the pixels.
  std::optional<Initialization> initialize(const CameraState& left, const Eigen::Vector3d& z) const;

  /// The same point, told by where it was seen from, the direction and the inverse depth: a disparity tells
  /// that one with an error that is nearly Gaussian, and a distance with one that is not.
  std::optional<InverseDepthInitialization> initialize_inverse_depth(const CameraState& left,
                                                                     const Eigen::Vector3d& z) const;

 private:
  std::optional<double> inverse_depth(const Eigen::Vector3d& ray, double u_right) const;
};

}  // namespace incognita
