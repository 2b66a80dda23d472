#include "incognita/slam/features/entropy.hpp"

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/belief_entropy.hpp"

namespace incognita {

double vehicle_entropy(const Estimate& estimate) {
  const BlockMatrix P = estimate.belief.covariance(estimate.camera);
  return gaussian_entropy(log_det(P), static_cast<int>(P.rows()));
}

Entropy all_entropies(const Estimate& estimate) {
  return entropies_of(estimate.belief, FreeCameraMotion::error_size);
}

}  // namespace incognita
