// Entropies of camera, map and both: thesis (6.2), as plotted in Figures 6.4 and 6.7.
#pragma once

#include "incognita/slam/features/estimate.hpp"

namespace incognita {

/// Entropy of the camera: 12 x 12, every frame.
double vehicle_entropy(const Estimate& estimate);

/// All three entropies. One Cholesky factorization of the covariance with the camera last gives map and
/// total; it is cubic in the map and therefore done about once a second.
Entropy all_entropies(const Estimate& estimate);

}  // namespace incognita
