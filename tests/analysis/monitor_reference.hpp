// Dense reference of the observability monitor, for tests.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <map>
#include <set>
#include <vector>

#include "incognita/analysis/observability/observability_monitor.hpp"
#include "incognita/math/random.hpp"

namespace incognita::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

inline constexpr BlockId vehicle = 0;

inline MatrixXd random_matrix(RandomStream& random, Eigen::Index rows, Eigen::Index columns) {
  MatrixXd M(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) M(i, j) = random.normal();
  return M;
}

inline MatrixXd pseudo_inverse(const MatrixXd& M) {
  return M.completeOrthogonalDecomposition().pseudoInverse();
}

inline Eigen::Index rank_of(const MatrixXd& M) {
  Eigen::JacobiSVD<MatrixXd> svd(M);
  svd.setThreshold(1e-9);
  return svd.rank();
}

/// Dense reference: information over the errors of the present vehicle and of all blocks that ever existed,
/// with dropped blocks marginalized only at the end; motions by the matrix inversion lemma, after
/// marginalizing the directions that they forget.
struct DenseReference {
  explicit DenseReference(int errors) : size(errors), Y(MatrixXd::Zero(errors, errors)) {}

  void grow(BlockId id, Eigen::Index errors) {
    const Eigen::Index old = Y.rows();
    Y.conservativeResizeLike(MatrixXd::Zero(old + errors, old + errors));
    Y.bottomRows(errors).setZero();
    Y.rightCols(errors).setZero();
    first[id] = old;
    errors_of[id] = errors;
  }
  MatrixXd spread(BlockId id, const MatrixXd& H) const {
    MatrixXd all = MatrixXd::Zero(H.rows(), Y.cols());
    all.middleCols(id == vehicle ? 0 : first.at(id), H.cols()) = H;
    return all;
  }
  void add(const MatrixXd& H, const MatrixXd& R) { Y += H.transpose() * R.inverse() * H; }
  void move(const LinearizedMotion& m) {
    MatrixXd T = MatrixXd::Identity(Y.rows(), Y.cols());
    T.topLeftCorner(size, size) = pseudo_inverse(m.A);
    Eigen::FullPivLU<MatrixXd> lu{MatrixXd(m.A)};
    lu.setThreshold(1e-12);
    MatrixXd known = Y;
    if (lu.dimensionOfKernel() > 0) {
      MatrixXd W = MatrixXd::Zero(Y.rows(), lu.dimensionOfKernel());
      W.topRows(size) = lu.kernel();
      known -= Y * W * pseudo_inverse(W.transpose() * Y * W) * W.transpose() * Y;
    }
    const MatrixXd M = T.transpose() * known * T;
    const Eigen::JacobiSVD<MatrixXd> svd(MatrixXd(m.N), Eigen::ComputeFullU);
    MatrixXd G = MatrixXd::Zero(Y.rows(), size);
    G.topRows(size) = svd.matrixU() * svd.singularValues().cwiseSqrt().asDiagonal();
    const MatrixXd inner = MatrixXd::Identity(size, size) + G.transpose() * M * G;
    Y = M - M * G * inner.inverse() * G.transpose() * M;
  }
  /// Old errors y become K k + (T J)^+ T x, with k marginalized at the end.
  void replace(BlockId id, const MatrixXd& J, const MatrixXd& T) {
    const MatrixXd TJ = T * J;
    const Eigen::JacobiSVD<MatrixXd> svd(TJ, Eigen::ComputeFullV);
    const MatrixXd K = svd.matrixV().rightCols(TJ.cols() - TJ.rows());
    const Eigen::Index old = first.at(id), count = errors_of.at(id);
    const MatrixXd before = Y;
    grow(id, J.rows());
    MatrixXd C = MatrixXd::Identity(Y.rows(), Y.cols());  // old coordinates from (k in place of y, ..., x)
    C.block(old, old, count, count).setZero();
    C.block(old, old, count, K.cols()) = K;
    C.block(old, first[id], count, J.rows()) = pseudo_inverse(TJ) * T;
    MatrixXd padded = MatrixXd::Zero(Y.rows(), Y.cols());
    padded.topLeftCorner(before.rows(), before.cols()) = before;
    Y = C.transpose() * padded * C;
  }
  MatrixXd of(const std::vector<ObservabilityMonitor::Block>& blocks) const {
    std::vector<Eigen::Index> kept, gone;
    std::vector<bool> live(static_cast<std::size_t>(Y.rows()), false);
    for (const auto& b : blocks)
      for (int i = 0; i < b.errors; ++i) {
        kept.push_back((b.id == vehicle ? 0 : first.at(b.id)) + i);
        live[static_cast<std::size_t>(kept.back())] = true;
      }
    for (Eigen::Index i = 0; i < Y.rows(); ++i)
      if (!live[static_cast<std::size_t>(i)]) gone.push_back(i);
    if (gone.empty()) return Y(kept, kept);
    const MatrixXd cross = Y(kept, gone);
    return Y(kept, kept) - cross * pseudo_inverse(Y(gone, gone)) * cross.transpose();
  }

  Eigen::Index size;
  MatrixXd Y;
  std::map<BlockId, Eigen::Index> first, errors_of;
};

/// Random motions, measurements, initializations, replacements and drops, applied to the monitor and to the
/// reference.
class MonitorAndReference {
 public:
  MonitorAndReference(std::uint64_t seed, int errors)
      : random_(seed, "monitor"), errors_(errors), monitor(0, errors), reference(errors) {}

  void move(int noises, double noise) {
    move(MatrixXd::Identity(errors_, errors_) + 0.3 * random_matrix(random_, errors_, errors_), noises,
         noise);
  }
  void move(const MatrixXd& A, int noises, double noise) {
    LinearizedMotion m;
    m.block = vehicle;
    m.A = A;
    const MatrixXd G = noise * random_matrix(random_, errors_, noises);
    m.N = G * G.transpose();
    monitor.move(m);
    reference.move(m);
  }
  void measure_all(int times) {
    for (int i = 0; i < times; ++i)
      for (const BlockId id : live) add_measurement(id, 2);
  }
  void add_measurement(BlockId id, int rows) {
    LinearizedMeasurement measurement;
    const MatrixXd Hv = random_matrix(random_, rows, errors_), noise = random_matrix(random_, rows, rows);
    measurement.add(vehicle, Hv);
    measurement.R = MatrixXd::Identity(rows, rows) + noise * noise.transpose();
    measurement.residual = VectorXd::Zero(rows);
    MatrixXd all = reference.spread(vehicle, Hv);
    if (id != vehicle) {
      const MatrixXd Hl = random_matrix(random_, rows, reference.errors_of.at(id));
      measurement.add(id, Hl);
      all += reference.spread(id, Hl);
    }
    monitor.add_measurement(measurement);
    reference.add(all, measurement.R);
  }
  /// `assumed`: number of the block's last errors that are not measured but assumed.
  BlockId initialize(int size, int assumed) {
    BlockAugmentation initialization;
    initialization.block = ++last_;
    MatrixXd J = random_matrix(random_, size, errors_);
    J.bottomRows(assumed).setZero();
    initialization.parents.push_back({vehicle, J});
    const MatrixXd noise = random_matrix(random_, size, size);
    initialization.noise = 0.1 * MatrixXd::Identity(size, size) + noise * noise.transpose();
    monitor.augment(initialization);
    reference.grow(initialization.block, size);
    const int measured = size - assumed;
    const MatrixXd H = reference.spread(initialization.block, MatrixXd::Identity(measured, size)) -
                       reference.spread(vehicle, J.topRows(measured));
    reference.add(H, initialization.noise.topLeftCorner(measured, measured));
    live.insert(initialization.block);
    return initialization.block;
  }
  void replace(BlockId id, int size, bool noisy) {
    BlockReplacement r{id, random_matrix(random_, size, reference.errors_of.at(id)),
                       MatrixXd::Zero(size, size)};
    MatrixXd T = MatrixXd::Identity(size, size);
    if (noisy) {
      const VectorXd along = random_matrix(random_, size, 1);
      r.noise = along * along.transpose();
      const Eigen::JacobiSVD<MatrixXd> svd(MatrixXd(r.noise), Eigen::ComputeFullU);
      T = svd.matrixU().rightCols(size - 1).transpose();
    }
    reference.replace(id, r.J, T);
    monitor.replace(r);
  }
  void drop(BlockId id) {
    monitor.drop(id);
    live.erase(id);
  }
  void compare(const char* when) {
    const MatrixXd expected = reference.of(monitor.blocks()), Y = monitor.information();
    ASSERT_EQ(Y.rows(), expected.rows()) << when;
    EXPECT_LT((Y - expected).norm(), 1e-9 * (1 + reference.Y.norm())) << when;
  }

 private:
  RandomStream random_;
  int errors_;
  BlockId last_ = 0;

 public:
  ObservabilityMonitor monitor;
  DenseReference reference;
  std::set<BlockId> live;
};

}  // namespace incognita::testing
