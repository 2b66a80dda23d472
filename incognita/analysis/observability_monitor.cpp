#include "incognita/analysis/observability_monitor.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_pivot = 1e-12;  // of the largest: less cannot be divided by
constexpr double least_share = 1e-12;  // of a variance: less is rounding

/// M = F F', F with as many columns as M has rank, for M positive semi-definite: Cholesky's factor, the
/// largest pivot left first (Eigen's LDLT looks at the diagonal it began with). Told through the
/// correlations, so that metres and radians do not hide each other.
MatrixXd factor_of(const MatrixXd& M) {
  VectorXd sigma = M.diagonal().cwiseMax(0).cwiseSqrt();
  for (double& s : sigma)
    if (!(s > 0)) s = 1;
  const MatrixXd C = sigma.cwiseInverse().asDiagonal() * M * sigma.cwiseInverse().asDiagonal();
  MatrixXd F = MatrixXd::Zero(C.rows(), C.cols());
  VectorXd left = C.diagonal();
  Eigen::Index rank = 0, at = 0;
  for (; rank < C.rows() && left.maxCoeff(&at) > least_share; ++rank) {
    F.col(rank) = (C.col(at) - F.leftCols(rank) * F.row(at).head(rank).transpose()) / std::sqrt(left[at]);
    left -= F.col(rank).cwiseAbs2();
    left[at] = 0;
  }
  return sigma.asDiagonal() * F.leftCols(rank);
}

/// The orthogonal Q' that makes a matrix upper triangular, and that triangle.
struct Turn {
  MatrixXd Qt, R;
  explicit Turn(const MatrixXd& M) {
    const Eigen::HouseholderQR<MatrixXd> qr(M);
    Qt = qr.householderQ().adjoint();
    R = qr.matrixQR().triangularView<Eigen::Upper>();
  }
};

/// A square matrix: a basis of the null space of M, which has full rank, then M^+.
MatrixXd null_space_and_inverse(const MatrixXd& M) {
  const Eigen::Index rows = M.rows(), columns = M.cols();
  if (rows == 0) return MatrixXd::Identity(columns, columns);
  const Eigen::JacobiSVD<MatrixXd> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  MatrixXd C(columns, columns);
  C.leftCols(columns - rows) = svd.matrixV().rightCols(columns - rows);
  C.rightCols(rows) = svd.matrixV().leftCols(rows) * svd.singularValues().cwiseInverse().asDiagonal() *
                      svd.matrixU().transpose();
  return C;
}

}  // namespace

ObservabilityMonitor::ObservabilityMonitor(BlockId vehicle, int vehicle_errors)
    : blocks_{{vehicle, 0, vehicle_errors}}, V_(MatrixXd::Zero(vehicle_errors, vehicle_errors)) {
  put_index();
}

void ObservabilityMonitor::follow(const BeliefTrace& trace) {
  struct Visitor {
    ObservabilityMonitor& monitor;
    void operator()(const AffineMotion& motion) { monitor.move(motion); }
    void operator()(const AffineLook& look) { monitor.look(look); }
    void operator()(const BlockBirth& birth) { monitor.give_birth(birth); }
    void operator()(const BlockReplacement& replacement) { monitor.replace(replacement); }
    void operator()(const BlockDrop& drop) { monitor.drop(drop.block); }
    void operator()(Reshaping how) {
      monitor.uncovered_ = how == Reshaping::carried ? Uncovered::carried : Uncovered::decorrelated;
    }
  };
  for (const BeliefEvent& event : trace)
    if (!uncovered_) std::visit(Visitor{*this}, event);
}

void ObservabilityMonitor::put_index() {
  index_of_.assign(index_of_.size(), -1);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (index_of_.size() <= blocks_[i].id) index_of_.resize(blocks_[i].id + 1, -1);
    index_of_[blocks_[i].id] = static_cast<int>(i);
  }
}

const ObservabilityMonitor::Block* ObservabilityMonitor::find(BlockId id) const {
  if (id >= index_of_.size() || index_of_[id] < 0) return nullptr;
  return &blocks_[static_cast<std::size_t>(index_of_[id])];
}

const ObservabilityMonitor::Block& ObservabilityMonitor::find_or_add(BlockId id, int errors) {
  if (const Block* block = find(id)) return *block;
  const Eigen::Index old = V_.cols();
  V_.conservativeResize(Eigen::NoChange, old + errors);
  V_.rightCols(errors).setZero();
  L_.grow(errors);
  blocks_.push_back({id, static_cast<int>(old), errors});
  put_index();
  return blocks_.back();
}

// Motions
// ---------------------------------------------------------------------------------------------------------

/// Motions between looks are composed, and applied when the next look comes.
void ObservabilityMonitor::move(const AffineMotion& motion) {
  if (motion.block != blocks_.front().id) {
    uncovered_ = Uncovered::other_mover;
    return;
  }
  absorb_rows();
  if (!moved_) {
    A_ = motion.A;
    N_ = motion.N;
    moved_ = true;
    return;
  }
  A_ = (motion.A * A_).eval();
  N_ = (motion.A * N_ * motion.A.transpose() + motion.N).eval();
}

/// error before = A^-1 (error after - F w), w of unit covariance: rows for w, which is then eliminated.
void ObservabilityMonitor::apply_motion() {
  if (!moved_) return;
  moved_ = false;
  const Eigen::FullPivLU<MatrixXd> lu(MatrixXd(A_).transpose());
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return forget_vehicle();
  const int size = vehicle_errors();
  const MatrixXd before = lu.solve(V_.leftCols(size).transpose()).transpose();  // V A^-1
  const MatrixXd F = factor_of(N_);
  const Eigen::Index noises = F.cols(), landmarks = V_.cols() - size;
  MatrixXd rows = MatrixXd::Zero(noises + size, noises + size);
  rows.topLeftCorner(noises, noises).setIdentity();
  rows.bottomLeftCorner(size, noises) = -before * F;
  rows.bottomRightCorner(size, size) = before;
  const Turn turn(rows);
  V_.leftCols(size) = turn.R.bottomRightCorner(size, size);
  V_.rightCols(landmarks) = turn.Qt.bottomRightCorner(size, size) * V_.rightCols(landmarks);
}

/// What the vehicle's rows say of the landmarks alone stays.
void ObservabilityMonitor::forget_vehicle() {
  const int size = vehicle_errors();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(V_.leftCols(size));
  qr.setThreshold(least_pivot);
  MatrixXd rest = V_.rightCols(V_.cols() - size);
  rest.applyOnTheLeft(qr.householderQ().adjoint());
  L_.add(rest.bottomRows(size - qr.rank()));
  V_.setZero();
}

// Looks
// ---------------------------------------------------------------------------------------------------------

void ObservabilityMonitor::look(const AffineLook& look) {
  apply_motion();
  std::vector<Part> parts;
  for (int i = 0; i < look.part_count; ++i) {
    const LookJacobian& H = look.parts[i].H;
    parts.push_back({0, find_or_add(look.parts[i].block, static_cast<int>(H.cols())).first, H});
  }
  add_rows(parts, look.R);
}

void ObservabilityMonitor::give_birth(const BlockBirth& birth) {
  apply_motion();
  const Eigen::Index errors = birth.noise.rows();
  std::vector<Eigen::Index> measured;
  for (Eigen::Index i = 0; i < errors; ++i)
    if (std::any_of(birth.parents.begin(), birth.parents.end(),
                    [&](const BlockParent& parent) { return !parent.J.row(i).isZero(0); }))
      measured.push_back(i);
  const int first = find_or_add(birth.block, static_cast<int>(errors)).first;
  for (std::size_t from = 0; from < measured.size(); from += max_look_rows) {  // a look has so many rows
    const std::vector<Eigen::Index> some(
        measured.begin() + static_cast<std::ptrdiff_t>(from),
        measured.begin() + static_cast<std::ptrdiff_t>(std::min(measured.size(), from + max_look_rows)));
    const auto rows = static_cast<Eigen::Index>(some.size());
    const MatrixXd own = MatrixXd::Identity(errors, errors)(some, Eigen::all);
    std::vector<Part> parts{{0, first, own}};
    for (const BlockParent& parent : birth.parents) {
      const MatrixXd J = parent.J(some, Eigen::all);
      parts.push_back({0, find_or_add(parent.block, static_cast<int>(J.cols())).first, -J});
    }
    LookMatrix R = birth.noise(some, some);
    R.diagonal().array() += 1e-14 * std::max(1e-14, R.trace() / static_cast<double>(rows));
    add_rows(parts, R);
  }
}

void ObservabilityMonitor::add_rows(const std::vector<Part>& parts, const LookMatrix& R) {
  const Eigen::LLT<LookMatrix> llt(R);
  if (llt.info() != Eigen::Success) return;  // no update takes such a look
  for (const Part& part : parts) pending_.push_back({row_count_, part.first, llt.matrixL().solve(part.H)});
  row_count_ += static_cast<int>(R.rows());
}

/// V and the rows that wait are turned until nothing but V has to do with the vehicle.
void ObservabilityMonitor::absorb_rows() {
  if (row_count_ == 0) return;
  const int size = vehicle_errors();
  MatrixXd of_vehicle = MatrixXd::Zero(size + row_count_, size);
  of_vehicle.topRows(size) = V_.leftCols(size);
  for (const Part& part : pending_)
    if (part.first == 0) of_vehicle.middleRows(size + part.row, part.H.rows()) += part.H;
  const Turn turn(of_vehicle);
  MatrixXd of_map = turn.Qt.leftCols(size) * V_.rightCols(V_.cols() - size);
  for (const Part& part : pending_)
    if (part.first > 0)
      of_map.middleCols(part.first - size, part.H.cols()) +=
          turn.Qt.middleCols(size + part.row, part.H.rows()) * part.H;
  V_ << turn.R.topRows(size), of_map.topRows(size);
  L_.add(of_map.bottomRows(row_count_));
  pending_.clear();
  row_count_ = 0;
}

/// V from any rows; those that are left, free of the vehicle, go to the map.
void ObservabilityMonitor::put_rows(const MatrixXd& rows) {
  const int size = vehicle_errors();
  const Eigen::Index kept = std::min<Eigen::Index>(size, rows.rows()), landmarks = rows.cols() - size;
  const Turn turn(rows.leftCols(size));
  const MatrixXd of_map = turn.Qt * rows.rightCols(landmarks);
  V_.setZero();
  V_.topLeftCorner(kept, size) = turn.R.topRows(kept);
  V_.topRightCorner(kept, landmarks) = of_map.topRows(kept);
  L_.add(of_map.bottomRows(rows.rows() - kept));
}

// Blocks that go or change
// ---------------------------------------------------------------------------------------------------------

/// Takes out of L what it says of so many errors: rows over all errors, so that L = rows' rows + what is
/// left. With the block's own part B = F F': rows = F^+ (its rows of L).
MatrixXd ObservabilityMonitor::take_rows_of(int first, int count) {
  const int at = first - vehicle_errors();
  MatrixXd L = L_.matrix();
  const MatrixXd F = factor_of(L.block(at, at, count, count));
  MatrixXd rows = MatrixXd::Zero(F.cols(), V_.cols());
  if (F.cols() == 0) return rows;
  auto of_map = rows.rightCols(L.cols());
  of_map = F.completeOrthogonalDecomposition().pseudoInverse() * L.middleRows(at, count);
  L -= of_map.transpose() * of_map;
  L.middleRows(at, count).setZero();
  L.middleCols(at, count).setZero();
  L_.set(L);
  return rows;
}

/// Marginalises errors out; their columns stay, and are zero.
void ObservabilityMonitor::eliminate(int first, int count) {
  if (count == 0) return;
  absorb_rows();
  const MatrixXd taken = take_rows_of(first, count);
  MatrixXd rows(taken.rows() + V_.rows(), V_.cols());
  rows << taken, V_;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(rows.middleCols(first, count));
  qr.setThreshold(least_pivot);
  rows.applyOnTheLeft(qr.householderQ().adjoint());
  rows.middleCols(first, count).setZero();
  put_rows(rows.bottomRows(rows.rows() - qr.rank()));
}

/// Columns and rows of errors of which nothing is said any more.
void ObservabilityMonitor::remove_columns(int first, int count) {
  if (count == 0) return;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < V_.cols(); ++i)
    if (i < first || i >= first + count) kept.push_back(i);
  V_ = V_(Eigen::all, kept).eval();
  kept.erase(kept.begin(), kept.begin() + vehicle_errors());
  for (Eigen::Index& i : kept) i -= vehicle_errors();
  L_.set(L_.matrix()(kept, kept));
}

void ObservabilityMonitor::drop(BlockId id) {
  const Block* block = find(id);
  if (!block) return;
  eliminate(block->first, block->errors);
  shrink(*block, block->errors);
}

/// A block loses its first errors, of which nothing is said any more, or goes with its last.
void ObservabilityMonitor::shrink(const Block& block, int by) {
  remove_columns(block.first, by);
  const auto at = blocks_.begin() + (&block - blocks_.data());
  for (auto later = at + 1; later != blocks_.end(); ++later) later->first -= by;
  at->errors -= by;
  if (at->errors == 0) {
    blocks_.erase(at);
    put_index();
  }
}

/// These errors = C * as many others, told instead of them.
void ObservabilityMonitor::transform_block(int first, int count, const MatrixXd& C) {
  const int at = first - vehicle_errors();
  V_.middleCols(first, count) = (V_.middleCols(first, count) * C).eval();
  MatrixXd L = L_.matrix();
  L.middleCols(at, count) = (L.middleCols(at, count) * C).eval();
  L.middleRows(at, count) = (C.transpose() * L.middleRows(at, count)).eval();
  L_.set(L);
}

/// U' (new error) = (anything; T J (old error)) with U' = (B'; T), B spanning the noise. The old error is
/// (T J)^+ (T new) and something of the null space of T J, which is not asked for any more.
void ObservabilityMonitor::replace(const BlockReplacement& r) {
  const Block* block = find(r.block);
  if (!block) return;
  absorb_rows();
  const int first = block->first, old = block->errors, size = static_cast<int>(r.J.rows());
  const Eigen::JacobiSVD<MatrixXd> noise(MatrixXd(r.noise), Eigen::ComputeFullU);
  const double largest = noise.singularValues()[0];
  const auto noisy = static_cast<int>((noise.singularValues().array() > least_share * largest).count());
  const int known = size - noisy;
  const MatrixXd T = noise.matrixU().rightCols(known).transpose();
  transform_block(first, old, null_space_and_inverse(T * r.J));
  eliminate(first, old - known);
  shrink(*block, old - size);
  transform_block(first, size, noise.matrixU().transpose());
}

MatrixXd ObservabilityMonitor::information() {
  absorb_rows();
  apply_motion();
  MatrixXd Y = V_.transpose() * V_;
  Y.bottomRightCorner(L_.size(), L_.size()) += L_.matrix();
  return Y;
}

}  // namespace incognita
