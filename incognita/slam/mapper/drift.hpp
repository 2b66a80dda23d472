// The correction of a drift: while landmarks are out of view, the body and the landmarks in view move together relative to them,
// and images do not show it until they return. A filter whose covariance is too small, by linearization or by errors that last,
// then expects them elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

/// A similarity transform of the body, world axes, that corrects its drift; the mean of its scale is 1.
struct DriftCorrection {
  Eigen::Vector3d center{0, 0, 0};       ///< position of the body before, m
  Eigen::Vector3d translation{0, 0, 0};  ///< m, of the body
  Eigen::Vector3d turn{0, 0, 0};         ///< rotation vector about the body, rad
  /// Of translation, turn after it, and the logarithm of the scale.
  Eigen::Matrix<double, 7, 7> cov = Eigen::Matrix<double, 7, 7>::Zero();
};

/// A landmark of the belief that drifted, with its share of the drift: 1 if it is seen now, 0 if it was seen when the drift began.
struct DriftingLandmark {
  std::int64_t id = 0;
  double share = 0;
};

/// The rigid motion that is a share of a correction.
class PartialCorrection {
 public:
  PartialCorrection(const DriftCorrection& correction, double share);

  const Eigen::Matrix3d& rotation() const { return R_; }
  double share() const { return share_; }
  Eigen::Vector3d moved(const Eigen::Vector3d& point) const { return center_next_ + R_ * (point - center_); }
  /// The orientation of axes that were `world_from_axes`.
  Eigen::Vector4d turned(const Eigen::Vector4d& world_from_axes) const;
  /// Derivative of a point that was moved to `at` by the errors of the correction: 3 x 7.
  Eigen::Matrix<double, 3, 7> of_point(const Eigen::Vector3d& at) const;
  /// Derivative of a vector from the body by turn and scale: 3 x 4.
  Eigen::Matrix<double, 3, 4> of_vector(const Eigen::Vector3d& v) const;

 private:
  Eigen::Matrix3d R_;
  Eigen::Vector3d center_, center_next_;
  double share_;
};

/// Moves the body, a free camera, by the correction and these landmarks by their shares. The drift is taken for a Brownian motion
/// of ten independent increments: what was seen at the same time drifted together, and the uncertainty of what was seen earlier is
/// less, but partly its own. Covariance form only; quadratic in the map, allocates.
void correct_drift(Estimate& estimate, std::size_t body, const DriftCorrection& correction,
                   const std::vector<DriftingLandmark>& landmarks);

}  // namespace incognita
