#include "incognita/belief/information_belief.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "incognita/belief/rank_update.hpp"

namespace incognita {
namespace {

/// Inverse of a matrix that must be positive definite; throws std::invalid_argument if it is not.
BlockMatrix inverse_of(const Eigen::Ref<const Eigen::MatrixXd>& covariance, const char* what) {
  const BlockMatrix given = covariance;
  const Eigen::LLT<BlockMatrix> llt(given);
  if (llt.info() != Eigen::Success)
    throw std::invalid_argument(
        std::string(what) +
        " is not positive definite: exact knowledge is infinite information, which the information form cannot represent");
  return llt.solve(BlockMatrix::Identity(given.rows(), given.cols()));
}

/// A matrix B with B B' = noise.
BlockMatrix root_of(const BlockMatrix& noise) {
  const Eigen::SelfAdjointEigenSolver<BlockMatrix> eigen(noise);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// Expresses x and w by y = J x + B w and a complement k: the inverse of an invertible matrix whose first
/// rows are [J B] and whose other rows are orthonormal and orthogonal to those.
struct Complement {
  BlockMatrix x_by_y, x_by_k, w_by_y, w_by_k;

  Complement(const BlockMatrix& J, const BlockMatrix& B) {
    using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * max_small, 2 * max_small>;
    const Eigen::Index x = J.cols(), y = J.rows(), w = B.cols();
    Wide rows(x + w, y);
    rows.topRows(x) = J.transpose();
    rows.bottomRows(w) = B.transpose();
    const Eigen::HouseholderQR<Wide> qr(rows);
    const Wide Q = qr.householderQ() * Wide::Identity(x + w, x + w);
    const Wide R = qr.matrixQR().topRows(y);  // upper triangle only
    const BlockVector pivots = R.diagonal().cwiseAbs();
    if (pivots.allFinite() &&
        !(pivots.minCoeff() > std::numeric_limits<double>::epsilon() * pivots.maxCoeff()))
      throw std::invalid_argument(
          "a direction of the block would be known exactly: infinite information, which the information form cannot represent");
    const Wide by_y = R.triangularView<Eigen::Upper>().solve(Q.leftCols(y).transpose()).transpose();
    x_by_y = by_y.topRows(x);
    w_by_y = by_y.bottomRows(w);
    x_by_k = Q.rightCols(x + w - y).topRows(x);
    w_by_k = Q.rightCols(x + w - y).bottomRows(w);
  }
};

}  // namespace

BlockMatrix InformationBelief::covariance(BlockId row, BlockId column) const {
  const Block &a = block(row), &b = block(column);
  const ReverseFactor* known = factor();
  if (known == nullptr)
    return BlockMatrix::Constant(a.chart.tangent(), b.chart.tangent(),
                                 std::numeric_limits<double>::quiet_NaN());
  return known->inverse(a.error, a.chart.tangent(), b.error, b.chart.tangent());
}

Eigen::MatrixXd InformationBelief::dense_covariance() const {
  Eigen::MatrixXd P(errors_, errors_);
  for (const Block& a : blocks_)
    for (const Block& b : blocks_)
      P.block(a.error, b.error, a.chart.tangent(), b.chart.tangent()) = covariance(a.id, b.id);
  return P;
}

Eigen::MatrixXd InformationBelief::dense_information() const {
  return Eigen::MatrixXd::NullaryExpr(errors_, errors_, [this](Eigen::Index i, Eigen::Index j) {
    return information_.entry(static_cast<int>(i), static_cast<int>(j));
  });
}

InformationBelief::LogDeterminants InformationBelief::log_determinants(int first) const {
  const ReverseFactor* known = factor();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (known == nullptr) return {nan, nan, nan};
  // det P = det P_others * det P_first|others, and the latter is the inverse of the first errors' own information
  ReverseFactor own;
  own.load(information_, first);
  const double given_others = own.factorize() ? -own.log_det() : nan;
  return {known->log_det_of_inverse(first), -known->log_det() - given_others, -known->log_det()};
}

const ReverseFactor* InformationBelief::factor() const {
  if (!factor_known_) {
    factor_.load(information_, errors_);
    factor_positive_ = factor_.factorize();
    factor_known_ = true;
  }
  return factor_positive_ ? &factor_ : nullptr;
}

void InformationBelief::reserve(int errors) {
  if (information_.reserve(errors, errors_)) size_workspace();
}

void InformationBelief::size_workspace() {
  cross_ = AlignedBuffer(static_cast<std::size_t>(information_.stride) * max_block_size);
  packed_ = AlignedBuffer(static_cast<std::size_t>(information_.stride + round_up_to_panel(max_block_size)) *
                          max_block_size);
}

BlockId InformationBelief::add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                                       const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  check_vehicle(chart, mean, covariance);
  const BlockMatrix own = inverse_of(covariance, "the covariance of a vehicle");
  return append_independent(chart, mean, own, true);
}

BlockId InformationBelief::augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                                   std::span<const BlockParent> parents,
                                   const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  check_new_block(chart, mean, parents, noise);
  const BlockMatrix own = inverse_of(noise, "the noise of a landmark");
  const BlockId id = append_independent(chart, mean, own, false);
  // New error - J * parents' errors = noise: equivalent to a measurement of all of them
  const int first = block(id).error;
  for (const BlockParent& parent : parents) {
    const Block& from = block(parent.block);
    const BlockMatrix weighted = own * parent.J;
    for (int j = 0; j < weighted.cols(); ++j)
      for (int i = 0; i < weighted.rows(); ++i)
        information_.column(from.error + j)[first + i] -= weighted(i, j);
    for (const BlockParent& other : parents) {
      const int at = block(other.block).error;
      const BlockMatrix shared = other.J.transpose() * weighted;
      for (int j = 0; j < shared.cols(); ++j)
        for (int i = 0; i < shared.rows(); ++i)
          if (at + i >= from.error + j) information_.column(from.error + j)[at + i] += shared(i, j);
    }
  }
  if (trace_) trace_->emplace_back(BlockAugmentation{id, {parents.begin(), parents.end()}, noise});
  return id;
}

BlockId InformationBelief::append_independent(const Chart& chart,
                                              const Eigen::Ref<const Eigen::VectorXd>& mean,
                                              const BlockMatrix& own, bool vehicle) {
  const int first = errors_, size = chart.tangent();
  reserve(first + size);
  const BlockId id = vehicle ? append_vehicle(chart, mean) : append(chart, mean);
  for (int j = 0; j < first; ++j) std::fill_n(information_.column(j) + first, size, 0.0);
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) information_.column(first + j)[first + i] = own(i, j);
  changed();
  return id;
}

void InformationBelief::replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                                const BlockMatrix& J, const BlockMatrix& noise) {
  check_replacement(id, chart, mean, J, noise);
  const Block b = block(id);
  transform(b, J, noise);
  const int size = chart.tangent(), gone = b.chart.tangent() - size;
  if (gone > 0) information_.remove(b.error + size, gone, errors_);
  rechart(id, chart, mean);
  if (trace_) trace_->emplace_back(BlockReplacement{id, J, noise});
}

void InformationBelief::drop(BlockId id) {
  const Block b = block(id);
  fill_cross(b, b.chart.tangent(), [](const auto& of_block) { return of_block; });
  marginalize(own_information(b));
  information_.remove(b.error, b.chart.tangent(), errors_);
  forget(id);
  note(BlockDrop{id});
}

void InformationBelief::predict(const LinearizedMotion& motion) {
  check(motion);
  transform(block(motion.block), motion.A, motion.N);
  set_mean(motion.block, motion.x_next);
  note(motion);
}

BlockMatrix InformationBelief::own_information(const Block& b) const {
  const int size = b.chart.tangent();
  BlockMatrix own(size, size);
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) own(i, j) = information_.entry(b.error + i, b.error + j);
  return own;
}

/// cross_ <- `cross` applied to the information of each error with the block (a row vector); 0 in the block's
/// own rows.
template <class Cross>
void InformationBelief::fill_cross(const Block& b, int columns, const Cross& cross) {
  const int size = b.chart.tangent();
  std::fill_n(cross_.data(), static_cast<long>(information_.stride) * columns, 0.0);
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, max_block_size>;
  Row of_block(size), made(columns);
  for (int r = 0; r < errors_; ++r) {
    if (r >= b.error && r < b.error + size) continue;
    for (int k = 0; k < size; ++k) of_block[k] = information_.entry(r, b.error + k);
    made = cross(of_block);
    for (int k = 0; k < columns; ++k) cross_.data()[r + static_cast<long>(k) * information_.stride] = made[k];
  }
}

/// Transforms the block's error x to y = J x + B w, with w of unit covariance and B B' the noise: (x, w) are
/// expressed by (y, k), and k is marginalized out. If y has fewer errors than x, the surplus rows and columns
/// are invalid afterwards.
void InformationBelief::transform(const Block& b, const BlockMatrix& J, const BlockMatrix& noise) {
  const Complement by(J, root_of(noise));
  const BlockMatrix x = own_information(b);
  const int size = static_cast<int>(J.rows()), old = b.chart.tangent(), marginal = old;
  const BlockMatrix y = by.x_by_y.transpose() * x * by.x_by_y + by.w_by_y.transpose() * by.w_by_y;
  const BlockMatrix y_k = by.x_by_y.transpose() * x * by.x_by_k + by.w_by_y.transpose() * by.w_by_k;
  const BlockMatrix k = by.x_by_k.transpose() * x * by.x_by_k + by.w_by_k.transpose() * by.w_by_k;
  fill_cross(b, marginal, [&](const auto& of_x) { return (of_x * by.x_by_k).eval(); });
  for (int j = 0; j < marginal; ++j)
    for (int i = 0; i < size; ++i)
      cross_.data()[b.error + i + static_cast<long>(j) * information_.stride] = y_k(i, j);
  BlockVector of_x(old);
  for (int r = 0; r < errors_; ++r) {
    if (r >= b.error && r < b.error + old) continue;
    const auto at = [&](int i) -> double& {
      return r > b.error ? information_.column(b.error + i)[r] : information_.column(r)[b.error + i];
    };
    for (int i = 0; i < old; ++i) of_x[i] = at(i);
    for (int i = 0; i < size; ++i) at(i) = by.x_by_y.col(i).dot(of_x);
  }
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) information_.column(b.error + j)[b.error + i] = y(i, j);
  marginalize(k);
}

/// Marginalizes out errors with information `own`; cross_ is their information with all others.
void InformationBelief::marginalize(const BlockMatrix& own) {
  changed();
  const int count = static_cast<int>(own.rows());
  const Eigen::LLT<BlockMatrix> llt(own);
  BlockMatrix L = llt.matrixL();
  // The information is lost to rounding: covariance() then returns NaN
  if (llt.info() != Eigen::Success) L.setConstant(std::numeric_limits<double>::quiet_NaN());
  whiten(cross_.data(), information_.stride, errors_, L.data(), static_cast<int>(L.outerStride()), count,
         packed_.data());
  rank_update(information_.storage.data(), information_.stride, errors_, packed_.data(), count);
}

}  // namespace incognita
