#include "incognita/slam/mapper/belief_entropy.hpp"

#include "incognita/belief/cholesky.hpp"
#include "incognita/math/gaussian.hpp"

namespace incognita {

Entropy entropies_of(const Belief& belief, int vehicle) {
  const int size = belief.errors(), map = size - vehicle;
  const int stride = round_up_to_panel(size) + rank_update_panel;
  const Eigen::MatrixXd P = belief.dense_covariance();
  AlignedBuffer storage(static_cast<std::size_t>(stride) * size), workspace(cholesky_workspace(size));
  // Vehicles come first in the state. They are ordered last here, so that the leading part of the factor is the map's
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> ordered(storage.data(), size, size,
                                                               Eigen::OuterStride<>(stride));
  ordered.topLeftCorner(map, map) = P.bottomRightCorner(map, map);
  ordered.bottomLeftCorner(vehicle, map) = P.topRightCorner(vehicle, map);
  ordered.bottomRightCorner(vehicle, vehicle) = P.topLeftCorner(vehicle, vehicle);
  Entropy entropy;
  entropy.vehicle = gaussian_entropy(log_det(P.topLeftCorner(vehicle, vehicle)), vehicle);
  if (!cholesky(storage.data(), stride, size, workspace.data())) return entropy;
  const auto log_diagonal = ordered.diagonal().array().log();
  entropy.map = gaussian_entropy(2 * log_diagonal.head(map).sum(), map);
  entropy.total = gaussian_entropy(2 * log_diagonal.sum(), map + vehicle);
  return entropy;
}

Entropy entropies_of(const InformationBelief& belief, int vehicle) {
  const InformationBelief::LogDeterminants of = belief.log_determinants(vehicle);
  const int all = belief.errors();
  return {gaussian_entropy(of.first, vehicle), gaussian_entropy(of.others, all - vehicle),
          gaussian_entropy(of.all, all)};
}

Entropy entropies_of(const AnyBelief& belief, int vehicle) {
  return std::visit([&](const auto& form) { return entropies_of(form, vehicle); }, belief.form());
}

}  // namespace incognita
