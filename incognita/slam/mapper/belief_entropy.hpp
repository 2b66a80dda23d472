// Entropies of a belief: thesis (6.2).
#pragma once

#include "incognita/belief/any_belief.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {

/// Entropies of the first `vehicle` errors (the vehicles), of the rest (the map) and of all. One Cholesky
/// factorization of the covariance with the vehicles last gives both map and total; cubic in the map. NaN
/// when the covariance is not positive definite.
Entropy entropies_of(const Belief& belief, int vehicle);
/// The same from the factor that the information form computes anyway.
Entropy entropies_of(const InformationBelief& belief, int vehicle);
Entropy entropies_of(const AnyBelief& belief, int vehicle);

}  // namespace incognita
