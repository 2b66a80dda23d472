#include "incognita/decision/extended_entropy.hpp"

#include <algorithm>

#include "incognita/belief/cholesky.hpp"
#include "incognita/decision/exploration.hpp"
#include "incognita/math/gaussian.hpp"

namespace incognita {
namespace {

constexpr double least_inverse_depth_per_m = 0.01;  // a point at infinity has no Cartesian position

Eigen::Index rows_of(const std::vector<LinearTransform>& transforms) {
  Eigen::Index rows = 0;
  for (const LinearTransform& part : transforms) rows += part.J.rows();
  return rows;
}

std::optional<double> with_unmapped(double entropy, int mapped, const ExplorationSettings& exploration,
                                    int dimensions) {
  const int unmapped = exploration.expected_landmarks - mapped;
  if (unmapped < 0) return std::nullopt;
  return entropy + entropy_of_unmapped(unmapped, exploration.variance_expected_m2, dimensions);
}

}  // namespace

double entropy_of(const Eigen::MatrixXd& P, const std::vector<LinearTransform>& transforms) {
  const Eigen::Index size = rows_of(transforms);
  Eigen::MatrixXd JP(size, P.cols()), JPJ(size, size);
  Eigen::Index at = 0;
  for (const LinearTransform& part : transforms) {
    JP.middleRows(at, part.J.rows()).noalias() = part.J * P.middleRows(part.first, part.J.cols());
    at += part.J.rows();
  }
  at = 0;
  for (const LinearTransform& part : transforms) {
    JPJ.middleCols(at, part.J.rows()).noalias() =
        JP.middleCols(part.first, part.J.cols()) * part.J.transpose();
    at += part.J.rows();
  }
  return gaussian_entropy(log_determinant(JPJ), static_cast<int>(size));
}

std::optional<double> extended_entropy(const Estimate& estimate, const ExplorationSettings& exploration) {
  const AnyBelief& belief = estimate.belief;
  std::vector<LinearTransform> transforms;
  int dimensions = 3;  // landmark dimension, equal for all landmarks
  for (const Body& body : estimate.bodies) {
    const int errors = belief.chart(body.block).tangent();
    transforms.push_back({belief.offset(body.block), BlockMatrix::Identity(errors, errors)});
  }
  int mapped = 0;
  for (const auto& [id, landmark] : estimate.landmarks) {
    if (!landmark.mapped()) continue;
    SmallVector mean = belief.mean(landmark.block);
    if (landmark.form.kind == LandmarkParametrization::Kind::inverse_depth) {
      double& inverse_depth = mean[mean.size() - 1];
      inverse_depth = std::max(inverse_depth, least_inverse_depth_per_m);
    }
    const auto at = position_of(landmark.form, mean);
    if (!at) continue;
    transforms.push_back({belief.offset(landmark.block), at->J});
    dimensions = static_cast<int>(at->J.rows());
    ++mapped;
  }
  return with_unmapped(entropy_of(belief.dense_covariance(), transforms), mapped, exploration, dimensions);
}

}  // namespace incognita
