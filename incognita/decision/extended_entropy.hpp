// Entropy of the extended covariance of thesis Figure 6.3: vehicles, map points, and landmarks expected but not yet
// mapped. Its dimension does not depend on how many were mapped, so that runs with different maps are comparable.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

/// Part of the extended state, to first order: J times the errors of the belief from index `first` on.
struct LinearTransform {
  int first = 0;
  BlockMatrix J;  ///< errors of the part x errors of the block
};

/// Entropy in nats of linear functions of errors with covariance `P`. NaN if their covariance is not positive
/// definite. Cost is cubic in their dimension.
double entropy_of(const Eigen::MatrixXd& P, const std::vector<LinearTransform>& transforms);

/// Entropy in nats of bodies, map (as points) and unmapped landmarks, in the dimension of the map. Empty if more landmarks are mapped than
/// were expected, since the dimension would differ.
std::optional<double> extended_entropy(const Estimate& estimate, const ExplorationSettings& exploration);

}  // namespace incognita
