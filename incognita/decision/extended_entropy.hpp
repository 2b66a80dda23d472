// The extended covariance of thesis Figure 6.3: of vehicles, the points of the map, and the landmarks that
// are expected and not mapped yet. Its dimension is the same whatever was mapped, so that runs whose maps
// differ can be compared.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/points/team_estimate.hpp"

namespace incognita {

/// A part of the extended state, by first order: J times the error of the belief from `first` on.
struct LinearTransform {
  int first = 0;
  BlockMatrix J;  ///< errors as they are told x errors of the block
};

/// Entropy in nats of what is told of the errors of covariance `P`. Not a number where its covariance is not
/// positive definite. Cubic in what is told.
double entropy_of(const Eigen::MatrixXd& P, const std::vector<LinearTransform>& transforms);

/// Of camera, map and what is not mapped, in nats; landmarks are told as points. None once more are mapped
/// than were expected: its dimension would be another.
std::optional<double> extended_entropy(const Estimate& estimate, const ExplorationSettings& exploration);
/// Of all vehicles; landmarks in the dimensions of the place.
std::optional<double> extended_entropy(const TeamEstimate& estimate, const ExplorationSettings& exploration);

}  // namespace incognita
