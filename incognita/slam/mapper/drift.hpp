// The drift of an estimate: while landmarks are out of view, the body and the landmarks in view move together relative to them,
// and images do not show it until they return. A filter whose covariance is too small, by linearization or by errors that last,
// then expects them elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

/// A similarity transform about the body, world axes, that takes the estimate back; its scale is 1.
struct Drift {
  Eigen::Vector3d translation{0, 0, 0};  ///< m, of the body
  Eigen::Vector3d turn{0, 0, 0};         ///< rotation vector, rad
  /// Of translation, turn after it, and the logarithm of the scale.
  Eigen::Matrix<double, 7, 7> cov = Eigen::Matrix<double, 7, 7>::Zero();
};

/// The share of the drift that a landmark of the belief has: 1 if it is seen now, 0 if it was seen when the drift began.
struct DriftingLandmark {
  std::int64_t id = 0;
  double share = 0;
};

/// Takes the body, a free camera, and these landmarks back by their shares, and adds the uncertainty of the transform, which is
/// the same for all of them. Covariance form only; quadratic in the map, allocates.
void undo_drift(Estimate& estimate, std::size_t body, const Drift& drift,
                const std::vector<DriftingLandmark>& landmarks);

}  // namespace incognita
