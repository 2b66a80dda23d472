#include "incognita/slam/mapper/estimate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>

#include "incognita/math/gaussian.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/slam/mapper/belief_entropy.hpp"

namespace incognita {
namespace {

/// Position in the world of a landmark of a map in the vehicle frame.
LandmarkPosition out_of_vehicle_frame(const Landmark& landmark, const Estimate& e) {
  const Eigen::Vector2d mean = e.belief.mean(landmark.block);
  const planar::FramedPoint at = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)), mean);
  const SmallMatrix cross =
      at.by_point * e.belief.covariance(landmark.block, *e.world) * at.by_frame.transpose();
  return {at.point, at.by_frame * e.belief.covariance(*e.world) * at.by_frame.transpose() +
                        at.by_point * e.belief.covariance(landmark.block) * at.by_point.transpose() + cross +
                        cross.transpose()};
}

int vehicle_errors(const Estimate& e) {
  int errors = 0;
  for (const Body& body : e.bodies) errors += e.belief.chart(body.block).tangent();
  return errors;
}

/// Entropies with a block-diagonal map: sums over its blocks, and the Schur complement of the vehicle for the total.
Entropy entropies_of_arrow(const Estimate& e) {
  const BlockId vehicle = e.body().block;
  double map = 0;
  int errors = 0;
  Eigen::MatrixXd left = e.belief.covariance(vehicle);
  for (const auto& [id, landmark] : e.landmarks) {
    if (landmark.fixed) continue;
    const Eigen::MatrixXd own = e.belief.covariance(landmark.block);
    const Eigen::MatrixXd cross = e.belief.covariance(vehicle, landmark.block);
    map += log_det(own);
    left -= cross * own.inverse() * cross.transpose();
    errors += static_cast<int>(own.rows());
  }
  const int own = static_cast<int>(left.rows());
  return {gaussian_entropy(log_det(Eigen::MatrixXd(e.belief.covariance(vehicle))), own),
          gaussian_entropy(map, errors), gaussian_entropy(map + log_det(left), errors + own)};
}

/// Entropies of a map in the vehicle frame: the pose is that of the world relative to the vehicle.
Entropy entropies_in_vehicle_frame(const Estimate& e) {
  const Eigen::MatrixXd P = e.belief.dense_covariance();
  const Eigen::Index first = e.belief.offset(*e.world), rest = P.rows() - first - 3;
  const int errors = static_cast<int>(rest);
  return {gaussian_entropy(log_det(P.block(first, first, 3, 3)), 3),
          rest > 0 ? gaussian_entropy(log_det(P.bottomRightCorner(rest, rest)), errors) : 0,
          gaussian_entropy(log_det(P.bottomRightCorner(rest + 3, rest + 3)), errors + 3)};
}

}  // namespace

std::optional<LandmarkPosition> position_of(const Landmark& landmark, const Estimate& e) {
  if (landmark.fixed) {
    const Eigen::Index size = landmark.position.size();
    return LandmarkPosition{landmark.position, SmallMatrix::Zero(size, size)};
  }
  if (e.world) return out_of_vehicle_frame(landmark, e);
  const auto at = position_of(landmark.form, e.belief.mean(landmark.block));
  if (!at) return std::nullopt;
  return LandmarkPosition{at->position, at->J * e.belief.covariance(landmark.block) * at->J.transpose()};
}

namespace {

template <class Matrix>
double entropy_of(const Matrix& P) {
  const Eigen::LLT<Matrix> llt(P);
  if (llt.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  const Matrix& L = llt.matrixLLT();
  return gaussian_entropy(2 * L.diagonal().array().log().sum(), static_cast<int>(P.rows()));
}

template <class Matrix>
double entropy_of_bodies(const Estimate& e, int errors) {
  Matrix P(errors, errors);
  int row = 0;
  for (const Body& a : e.bodies) {
    int column = 0;
    for (const Body& b : e.bodies) {
      const BlockMatrix block = e.belief.covariance(a.block, b.block);
      P.block(row, column, block.rows(), block.cols()) = block;
      column += static_cast<int>(block.cols());
    }
    row += e.belief.chart(a.block).tangent();
  }
  return entropy_of(P);
}

}  // namespace

double vehicle_entropy(const Estimate& e) {
  if (e.world) return entropy_of(BlockMatrix(e.belief.covariance(*e.world)));
  const int errors = vehicle_errors(e);
  return errors <= max_small ? entropy_of_bodies<SmallMatrix>(e, errors)  // no allocation in the loop
                             : entropy_of_bodies<Eigen::MatrixXd>(e, errors);
}

Entropy entropies(const Estimate& e) {
  if (e.belief.drops_correlations()) return entropies_of_arrow(e);
  if (e.world) return entropies_in_vehicle_frame(e);
  return entropies_of(e.belief, vehicle_errors(e));
}

void refresh_entropy(Estimate& e, double t) {
  const double period_s = entropy_period_s(e.belief.errors());
  if (!e.entropy_t || has_come(*e.entropy_t + period_s, t)) {
    e.entropy = entropies(e);
    e.entropy_t = t;
  } else {
    e.entropy.vehicle = vehicle_entropy(e);
  }
}

}  // namespace incognita
