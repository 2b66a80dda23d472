// Entropies of camera, map and whole: thesis (6.2), as plotted in Figures 6.4 and 6.7.
#pragma once

#include "incognita/slam/features/estimate.hpp"

namespace incognita {

/// The camera's own entropy: 12 x 12, every frame.
double vehicle_entropy(const Estimate& estimate);

/// All three. One Cholesky factorisation of the covariance with the camera last gives map and whole together;
/// it grows with the cube of the map, so it is done about once a second.
Entropy all_entropies(const Estimate& estimate);

}  // namespace incognita
