#include "incognita/slam/belief_entropy.hpp"

#include <Eigen/Cholesky>

#include "incognita/math/gaussian.hpp"

namespace incognita {

Entropy entropies_of(const Belief& belief, int vehicle) {
  const int map = belief.errors() - vehicle;
  const Eigen::MatrixXd P = belief.dense_covariance();
  // What moves comes first: order it last, so that the leading part of the factor is the map's own
  Eigen::MatrixXd ordered(P.rows(), P.cols());
  ordered.topLeftCorner(map, map) = P.bottomRightCorner(map, map);
  ordered.bottomLeftCorner(vehicle, map) = P.topRightCorner(vehicle, map);
  ordered.bottomRightCorner(vehicle, vehicle) = P.topLeftCorner(vehicle, vehicle);
  Entropy entropy;
  entropy.vehicle = gaussian_entropy(log_det(P.topLeftCorner(vehicle, vehicle)), vehicle);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(ordered);
  if (llt.info() != Eigen::Success) return entropy;
  const auto log_diagonal = ordered.diagonal().array().log();
  entropy.map = gaussian_entropy(2 * log_diagonal.head(map).sum(), map);
  entropy.total = gaussian_entropy(2 * log_diagonal.sum(), map + vehicle);
  return entropy;
}

}  // namespace incognita
