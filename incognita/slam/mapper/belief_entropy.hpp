// Entropies of a belief: thesis (6.2).
#pragma once

#include "incognita/belief/any_belief.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {

/// Of its first `vehicle` errors, which are those of what moves, of the rest, and of all. One Cholesky
/// factorisation of the covariance with the vehicle last gives map and whole together; it grows with the cube
/// of the map. NaN where the covariance is not positive definite.
Entropy entropies_of(const Belief& belief, int vehicle);
/// The same from the factor that the information form has anyway.
Entropy entropies_of(const InformationBelief& belief, int vehicle);
Entropy entropies_of(const AnyBelief& belief, int vehicle);

}  // namespace incognita
