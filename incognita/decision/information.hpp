// Mutual information between the state and the measurements an action would give: thesis (6.6).
//
// The thesis takes determinants of the whole covariance. By the matrix determinant lemma the same number is
// (log|S| - log|R|)/2 with S the innovation covariance of the expected measurements, which is as small as
// they are few, does not underflow, and needs no posterior (tested equal on small maps).
#pragma once

#include <span>

#include "incognita/belief/belief.hpp"

namespace incognita {

/// A motion of one vehicle as it is imagined: error after = A * error before + noise of covariance N.
struct ImaginedMotion {
  BlockId vehicle = 0;
  BlockMatrix A, N;
};

/// I(X; Z) in nats for looks linearised at the imagined place. The belief is not touched.
/// `looks`: expected measurements; residuals are ignored. No looks give zero; NaN when S is not positive
/// definite.
class MutualInformation {
 public:
  double operator()(const Belief& belief, const ImaginedMotion& motion, std::span<const AffineLook> looks);

 private:
  std::vector<AffineLook> moved_;  // workspace: H_vehicle * A in place of H_vehicle
  Eigen::MatrixXd S_;
};

}  // namespace incognita
