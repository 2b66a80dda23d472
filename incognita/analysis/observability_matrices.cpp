#include "incognita/analysis/observability_matrices.hpp"

#include <Eigen/SVD>
#include <unsupported/Eigen/MatrixFunctions>

namespace incognita {
namespace {

constexpr double rounding = 1e-13;  // of a sum, relative to its terms

}  // namespace

NoisyRows segment_observability(const Linearisation& segment) {
  const Eigen::Index n = segment.F.rows();
  NoisyRows Q{Eigen::MatrixXd(0, n), {}, false};
  Eigen::MatrixXd block = segment.H;
  Eigen::VectorXd H_terms = segment.H_terms;
  // Only directions matter: rows begin with entries of at most 1, so that no square of theirs leaves the
  // range
  for (Eigen::Index i = 0; i < block.rows(); ++i) {
    const double largest = block.row(i).cwiseAbs().maxCoeff();
    if (!(largest > 0)) continue;
    block.row(i) /= largest;
    H_terms[i] /= largest;
  }
  // How large the terms are that the entries of a row were added up from
  Eigen::MatrixXd terms = block.cwiseAbs().cwiseMax(H_terms.replicate(1, n) * 1e-3);
  const Eigen::MatrixXd F_terms = segment.F.cwiseAbs();
  for (Eigen::Index power = 0; power < n; ++power) {
    const Eigen::VectorXd noise = rounding * double(n) * terms.rowwise().norm();
    if ((block.rowwise().norm().array() <= noise.array()).all()) break;
    Q.append(block, noise);
    block = (block * segment.F).eval();
    terms = (terms * F_terms).eval();
    // Only directions matter: rows keep a length that the next power cannot make overflow
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      const double length = block.row(i).norm();
      if (!(length > 0)) continue;
      block.row(i) /= length;
      terms.row(i) /= length;
    }
  }
  return Q;
}

NoisyRows stripped_observability(const std::vector<Linearisation>& segments, int k) {
  NoisyRows all{Eigen::MatrixXd(0, segments.front().F.cols()), {}, false};
  for (int j = 0; j < k; ++j) {
    const NoisyRows Q = segment_observability(segments[static_cast<std::size_t>(j)]);
    all.append(Q.rows, Q.noise);
  }
  return all;
}

NoisyRows total_observability(const std::vector<Linearisation>& segments,
                              const std::vector<double>& durations_s, int k) {
  const Eigen::Index n = segments.front().F.cols();
  NoisyRows all{Eigen::MatrixXd(0, n), {}, false};
  Eigen::MatrixXd to_start = Eigen::MatrixXd::Identity(n, n);
  for (int j = 0; j < k; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const NoisyRows Q = segment_observability(segments[at]);
    all.append(Q.rows * to_start, Q.noise * to_start.norm());
    to_start = ((segments[at].F * durations_s[at]).exp() * to_start).eval();
  }
  return all;
}

bool null_space_stays(const Linearisation& segment, const NullSpace& of_segment) {
  const double size = segment.F.norm();
  return of_segment.nullity == 0 || !(size > 0) ||
         (segment.F * of_segment.basis).norm() <= 1e-9 * size * of_segment.basis.norm();
}

namespace {

/// What is left of the columns of M once combinations of the columns of J are taken out.
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
  Eigen::MatrixXd M(rows, n), J(rows, jumps);
  Eigen::Index row = 0;
  for (const MotionSample& sample : samples) {
    const Linearisation at = instance.linearise(sample.point);
    Eigen::VectorXd size = whitened ? at.sigma : Eigen::VectorXd(at.H.cwiseAbs().rowwise().maxCoeff());
    for (double& s : size) s = s > 0 ? s : 1;
    const Eigen::MatrixXd H = size.cwiseInverse().asDiagonal() * at.H;
    M.middleRows(row, m) = H * sample.Phi;
    J.middleRows(row, m) = H * sample.jumps;
    row += m;
  }
  NoisyRows local{without(M, J), Eigen::VectorXd::Zero(rows), true};
  return local;
}

}  // namespace incognita
