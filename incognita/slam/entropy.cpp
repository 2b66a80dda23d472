#include "incognita/slam/entropy.hpp"

#include <Eigen/Cholesky>

#include "incognita/math/gaussian.hpp"

namespace incognita {

double vehicle_entropy(const Estimate& estimate) {
  const BlockMatrix P = estimate.belief.covariance(estimate.camera);
  return gaussian_entropy(log_det(P), static_cast<int>(P.rows()));
}

Entropy all_entropies(const Estimate& estimate) {
  const Belief& belief = estimate.belief;
  const int camera = FreeCameraMotion::error_size, map = belief.errors() - camera;
  const Eigen::MatrixXd P = belief.dense_covariance();
  // The camera is the first block: order it last, so that the leading part of the factor is the map's own
  Eigen::MatrixXd ordered(P.rows(), P.cols());
  ordered.topLeftCorner(map, map) = P.bottomRightCorner(map, map);
  ordered.bottomLeftCorner(camera, map) = P.topRightCorner(camera, map);
  ordered.bottomRightCorner(camera, camera) = P.topLeftCorner(camera, camera);
  Entropy entropy;
  entropy.vehicle = vehicle_entropy(estimate);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(ordered);
  if (llt.info() != Eigen::Success) return entropy;
  const auto log_diagonal = ordered.diagonal().array().log();
  entropy.map = gaussian_entropy(2 * log_diagonal.head(map).sum(), map);
  entropy.total = gaussian_entropy(2 * log_diagonal.sum(), map + camera);
  return entropy;
}

}  // namespace incognita
