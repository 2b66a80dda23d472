#include "incognita/analysis/observability/observability_matrices.hpp"

#include <Eigen/SVD>
#include <unsupported/Eigen/MatrixFunctions>

namespace incognita {
namespace {

constexpr double rounding = 1e-13;  // relative to the terms of a sum

/// Bound of the number of linearly independent powers of F: the degree of its minimal polynomial is at most
/// its rank plus one.
Eigen::Index powers_that_count(const Eigen::MatrixXd& F) {
  const auto used = (F.array() != 0).eval();
  const Eigen::Index rows = used.rowwise().any().count(), columns = used.colwise().any().count();
  return std::min(F.rows(), 1 + std::min(rows, columns));
}

}  // namespace

NoisyRows segment_observability(const LinearizedSystem& segment) {
  const Eigen::Index n = segment.F.rows();
  NoisyRows Q{Eigen::MatrixXd(0, n), Eigen::MatrixXd(0, n), false, {}};
  Eigen::MatrixXd block = segment.H;
  // Magnitudes of the terms that were summed for each entry
  Eigen::MatrixXd terms = segment.H_terms.cwiseMax(segment.H.cwiseAbs());
  const Eigen::MatrixXd F_terms = segment.F_terms.cwiseMax(segment.F.cwiseAbs());
  for (Eigen::Index power = powers_that_count(segment.F); power > 0; --power) {
    // Only directions matter: rows are scaled so that the next power cannot overflow
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      const double largest = block.row(i).cwiseAbs().maxCoeff();
      if (!(largest > 0)) continue;
      block.row(i) /= largest;
      terms.row(i) /= largest;
    }
    const Eigen::MatrixXd noise = rounding * double(n) * terms;
    if ((block.cwiseAbs().array() <= noise.array()).all()) break;
    Q.append({block, noise, false, {}});
    block = (block * segment.F).eval();
    terms = (terms * F_terms).eval();
  }
  return Q;
}

std::vector<NoisyRows> segment_observability(const std::vector<LinearizedSystem>& segments) {
  std::vector<NoisyRows> Q;
  Q.reserve(segments.size());
  for (const LinearizedSystem& segment : segments) Q.push_back(segment_observability(segment));
  return Q;
}

std::vector<NoisyRows> stripped_observability(const std::vector<NoisyRows>& Q) {
  std::vector<NoisyRows> upto;
  for (const NoisyRows& segment : Q) {
    NoisyRows all = segment.condensed();
    if (!upto.empty()) all.append(upto.back());
    upto.push_back(all.condensed());
  }
  return upto;
}

std::vector<NoisyRows> total_observability(const std::vector<NoisyRows>& Q,
                                           const std::vector<LinearizedSystem>& segments,
                                           const std::vector<double>& durations_s) {
  const Eigen::Index n = segments.front().F.cols();
  std::vector<NoisyRows> moved;
  Eigen::MatrixXd to_start = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t j = 0; j < Q.size(); ++j) {
    const Eigen::MatrixXd terms = Q[j].rows.cwiseAbs() * to_start.cwiseAbs();
    moved.push_back({Q[j].rows * to_start,
                     (Q[j].noise * to_start.cwiseAbs()).cwiseMax(rounding * double(n) * terms),
                     false,
                     {}});
    to_start = ((segments[j].F * durations_s[j]).exp() * to_start).eval();
  }
  return stripped_observability(moved);
}

bool null_space_stays(const LinearizedSystem& segment, const NullSpace& of_segment) {
  // In scaled coordinates the null vectors have unit length and an accuracy of 1e-9
  const Eigen::MatrixXd F = segment.F * of_segment.column_scale.asDiagonal();
  const Eigen::VectorXd allowed = 1e-9 * F.cwiseAbs().rowwise().sum();
  const Eigen::VectorXd moved = (F * of_segment.scaled_null).rowwise().norm();
  return (moved.array() <= allowed.array()).all();
}

namespace {

/// Projects the columns of M onto the orthogonal complement of the columns of J.
Eigen::MatrixXd without(const Eigen::MatrixXd& M, const Eigen::MatrixXd& J) {
  if (J.cols() == 0) return M;
  Eigen::VectorXd scale = J.colwise().norm();
  for (double& s : scale) s = s > 0 ? 1 / s : 1;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(J * scale.asDiagonal(), Eigen::ComputeThinU);
  const auto& values = svd.singularValues();
  const auto rank = (values.array() > 1e-10 * values[0]).count();
  const auto U = svd.matrixU().leftCols(rank);
  return M - U * (U.transpose() * M);
}

}  // namespace

NoisyRows local_observability(const SystemInstance& instance, const std::vector<MotionSample>& samples,
                              bool whitened) {
  const Eigen::Index m = instance.measurements(), n = instance.states(), jumps = samples.front().jumps.cols();
  const auto rows = m * static_cast<Eigen::Index>(samples.size());
  const Eigen::VectorXd& units = instance.units();
  Eigen::MatrixXd M(rows, n), J(rows, jumps);
  Eigen::Index row = 0;
  for (const MotionSample& sample : samples) {
    const LinearizedSystem at = instance.linearize(sample.point);
    Eigen::VectorXd size =
        whitened ? at.sigma : Eigen::VectorXd((at.H * units.asDiagonal()).cwiseAbs().rowwise().maxCoeff());
    for (double& s : size) s = s > 0 ? s : 1;
    const Eigen::MatrixXd H = size.cwiseInverse().asDiagonal() * at.H;
    M.middleRows(row, m) = H * sample.Phi;
    J.middleRows(row, m) = H * sample.jumps;
    row += m;
  }
  NoisyRows local = NoisyRows::exact(without(M, J));
  local.weighed = true;
  // Phi is integrated to 1e-12 in the units of the states
  const Eigen::VectorXd columns = (M * units.asDiagonal()).cwiseAbs().colwise().maxCoeff();
  const double largest = columns.maxCoeff();
  local.noise.rowwise() = 1e-11 * largest * units.cwiseInverse().transpose();
  // States that do not affect a measurement have entries of exactly 0
  for (const double column : columns) local.faint.push_back(column > 1e-18 * largest);
  return local;
}

}  // namespace incognita
