#include "incognita/analysis/observability/observability_monitor.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_pivot = 1e-12;  // relative to the largest pivot: smaller ones count as zero
constexpr double least_share = 1e-12;  // relative to a variance: less is rounding

/// M = F F' for M positive semi-definite, F with rank(M) columns: Cholesky with pivoting on the remaining diagonal
/// (Eigen's LDLT uses the initial diagonal). Applied to correlations, so that meters and radians are comparable.
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

/// QR of the first columns: returns R, and Q' times the other columns. Applies the reflectors one by one; Q'
/// is never formed.
MatrixXd turned_upright(MatrixXd rows, Eigen::Index columns) {
  const Eigen::HouseholderQR<MatrixXd> qr(rows.leftCols(columns));
  rows.leftCols(columns) = qr.matrixQR().triangularView<Eigen::Upper>();
  auto others = rows.rightCols(rows.cols() - columns);
  others.applyOnTheLeft(qr.householderQ().adjoint());
  return rows;
}

/// Eliminates unknowns with coefficients `factors` from the rows.
MatrixXd rows_without(const MatrixXd& factors, MatrixXd rows) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(factors);
  qr.setThreshold(least_pivot);
  rows.applyOnTheLeft(qr.householderQ().adjoint());
  return rows.bottomRows(rows.rows() - qr.rank());
}

/// A = diag(rows) B diag(columns), with the largest entry of each row and column of B near 1, so that mixed
/// units do not make a matrix look singular.
struct Equilibrated {
  VectorXd rows, columns;
  MatrixXd B;
  explicit Equilibrated(const MatrixXd& A) : rows(A.rowwise().lpNorm<Eigen::Infinity>()), B(A) {
    for (double& r : rows)
      if (!(r > 0)) r = 1;
    B = rows.cwiseInverse().asDiagonal() * A;
    columns = B.colwise().lpNorm<Eigen::Infinity>().transpose();
    for (double& c : columns)
      if (!(c > 0)) c = 1;
    B = B * columns.cwiseInverse().asDiagonal();
  }
};

/// Whether A is invertible, with smallest over largest pivot above `least`.
bool can_be_undone(const MatrixXd& A, double least) {
  const Eigen::FullPivLU<MatrixXd> lu(Equilibrated(A).B);
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  return pivots.minCoeff() > least * pivots.maxCoeff();
}

/// Preimage under a singular motion A: all vectors that A maps to y are inverse * y + forgotten * anything.
struct PartlyUndone {
  MatrixXd inverse, forgotten;
  explicit PartlyUndone(const MatrixXd& A) {
    const Equilibrated e(A);
    const Eigen::JacobiSVD<MatrixXd> svd(e.B, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const auto& values = svd.singularValues();
    const Eigen::Index rank = (values.array() > least_pivot * values[0]).count();
    const MatrixXd V = e.columns.cwiseInverse().asDiagonal() * svd.matrixV();
    inverse = V.leftCols(rank) * values.head(rank).cwiseInverse().asDiagonal() *
              svd.matrixU().leftCols(rank).transpose() * e.rows.cwiseInverse().asDiagonal();
    forgotten = V.rightCols(A.cols() - rank);
  }
};

/// If an error of a new landmark copies one error of the parent, plus independent noise: the index of the
/// parent's error.
std::optional<Eigen::Index> copied_error(const BlockAugmentation& initialization, Eigen::Index row,
                                         BlockId parent) {
  std::optional<Eigen::Index> copied;
  for (const BlockParent& p : initialization.parents) {
    if (p.J.row(row).isZero(0)) continue;
    Eigen::Index at = 0;
    if (p.block != parent || copied || p.J.row(row).cwiseAbs().maxCoeff(&at) != 1 ||
        p.J.row(row).cwiseAbs().sum() != 1)
      return std::nullopt;
    copied = at;
  }
  if (initialization.noise.row(row).cwiseAbs().sum() != std::abs(initialization.noise(row, row)))
    return std::nullopt;
  return copied;
}

/// Square matrix: a basis of the null space of M, which has full rank, then M^+.
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

ObservabilityMonitor::ObservabilityMonitor(const std::vector<Vehicle>& vehicles, Motions motions)
    : motions_(motions) {
  for (const Vehicle& vehicle : vehicles) {
    index_of_[vehicle.block] = blocks_.size();
    blocks_.push_back({vehicle.block, vehicle_errors_, vehicle.errors});
    vehicle_errors_ += vehicle.errors;
  }
  V_ = MatrixXd::Zero(vehicle_errors_, vehicle_errors_);
  moved_.resize(vehicles.size());
}

void ObservabilityMonitor::follow(const BeliefTrace& trace) {
  struct Visitor {
    ObservabilityMonitor& monitor;
    void operator()(const LinearizedMotion& motion) { monitor.move(motion); }
    void operator()(const LinearizedMeasurement& measurement) { monitor.add_measurement(measurement); }
    void operator()(const BlockAugmentation& initialization) { monitor.augment(initialization); }
    void operator()(const BlockReplacement& replacement) { monitor.replace(replacement); }
    void operator()(const BlockShear& shear) { monitor.shear(shear); }
    void operator()(const BlockDrop& drop) { monitor.drop(drop.block); }
    void operator()(CovarianceEdit how) {
      switch (how) {
        case CovarianceEdit::frame_changed:
          monitor.uncovered_ = Uncovered::frame_changed;
          break;
        case CovarianceEdit::decorrelated:
          monitor.uncovered_ = Uncovered::decorrelated;
          break;
      }
    }
  };
  for (const BeliefEvent& event : trace)
    if (!uncovered_) std::visit(Visitor{*this}, event);
}

const ObservabilityMonitor::Block* ObservabilityMonitor::find(BlockId id) const {
  const auto at = index_of_.find(id);
  return at == index_of_.end() ? nullptr : &blocks_[at->second];
}

const ObservabilityMonitor::Block& ObservabilityMonitor::find_or_add(BlockId id, int errors) {
  if (const Block* block = find(id)) return *block;
  const Eigen::Index old = V_.cols();
  V_.conservativeResize(Eigen::NoChange, old + errors);
  V_.rightCols(errors).setZero();
  L_.grow(errors);
  added_.conservativeResize(L_.size());
  added_.tail(errors).setZero();
  index_of_[id] = blocks_.size();
  blocks_.push_back({id, static_cast<int>(old), errors});
  return blocks_.back();
}

// Motions
// ---------------------------------------------------------------------------------------------------------

/// Motions between measurements are composed and applied at the next measurement, as long as their product is well
/// conditioned. Invertibility is tested per motion, since many slight contractions never discard an error.
void ObservabilityMonitor::move(const LinearizedMotion& motion) {
  constexpr double well = 1e-6;  // relative to the largest pivot, equilibrated
  // Limits of |det| of a product; beyond them it is applied before composing
  constexpr double near_one = 1e-3;
  if (noises_.contains(motion.block)) return;
  const Block* block = find(motion.block);
  if (!block || !is_vehicle(*block)) {
    uncovered_ = Uncovered::other_block;
    return;
  }
  if (!motion.A.allFinite() || !motion.N.allFinite()) {
    uncovered_ = Uncovered::not_finite;
    return;
  }
  absorb_rows();
  const int all = vehicle_errors(), first = block->first, own = block->errors;
  if (motions_ == Motions::uninformative) return forget(MatrixXd::Identity(all, all).middleCols(first, own));
  if (!can_be_undone(motion.A, least_pivot)) {
    apply_motion();
    const PartlyUndone undone(motion.A);
    MatrixXd forgotten = MatrixXd::Zero(all, undone.forgotten.cols());
    forgotten.middleRows(first, own) = undone.forgotten;
    forget(forgotten);
    MatrixXd before = V_.leftCols(all), F = MatrixXd::Zero(all, own);
    before.middleCols(first, own) = (before.middleCols(first, own) * undone.inverse).eval();
    const MatrixXd noise = factor_of(motion.N);
    F.block(first, 0, own, noise.cols()) = noise;
    return put_motion(before, F.leftCols(noise.cols()));
  }
  Motion& last = moved_[index_of_.at(motion.block)];
  const BlockMatrix product = last.moved ? BlockMatrix(motion.A * last.A) : motion.A;
  const double volume = std::abs(product.determinant());
  if (last.moved && can_be_undone(product, well) && volume > near_one && volume < 1 / near_one) {
    last.A = product;
    last.N = (motion.A * last.N * motion.A.transpose() + motion.N).eval();
    return;
  }
  if (last.moved) apply_motion();
  last = {true, motion.A, motion.N};
}

void ObservabilityMonitor::apply_motion() {
  if (std::none_of(moved_.begin(), moved_.end(), [](const Motion& m) { return m.moved; })) return;
  const int all = vehicle_errors();
  MatrixXd before = V_.leftCols(all), F = MatrixXd::Zero(all, all);
  Eigen::Index noises = 0;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    if (!std::exchange(moved_[i].moved, false)) continue;
    const int first = blocks_[i].first, own = blocks_[i].errors;
    const Equilibrated e(moved_[i].A);
    const MatrixXd inverse = e.columns.cwiseInverse().asDiagonal() * e.B.fullPivLu().inverse() *
                             e.rows.cwiseInverse().asDiagonal();
    before.middleCols(first, own) = (before.middleCols(first, own) * inverse).eval();
    const MatrixXd noise = factor_of(moved_[i].N);
    F.block(first, noises, own, noise.cols()) = noise;
    noises += noise.cols();
  }
  put_motion(before, F.leftCols(noises));
}

/// error before = A^-1 (error after - F w), w of unit covariance: adds rows for w and eliminates it. `before`
/// is V A^-1.
void ObservabilityMonitor::put_motion(const MatrixXd& before, const MatrixXd& F) {
  const int size = vehicle_errors();
  const Eigen::Index noises = F.cols(), landmarks = V_.cols() - size;
  MatrixXd rows = MatrixXd::Zero(noises + size, noises + size);
  rows.topLeftCorner(noises, noises).setIdentity();
  rows.bottomLeftCorner(size, noises) = -before * F;
  rows.bottomRightCorner(size, size) = before;
  const Eigen::HouseholderQR<MatrixXd> qr(rows);
  const MatrixXd Qt = qr.householderQ().adjoint();  // small, while the map is wide
  V_.leftCols(size) =
      qr.matrixQR().triangularView<Eigen::Upper>().toDenseMatrix().bottomRightCorner(size, size);
  V_.rightCols(landmarks) = Qt.bottomRightCorner(size, size) * V_.rightCols(landmarks);
}

/// Reduces the vehicle's rows to those independent of the errors in these directions.
void ObservabilityMonitor::forget(const MatrixXd& directions) {
  const int size = vehicle_errors();
  const MatrixXd left = rows_without(V_.leftCols(size) * directions, V_);
  V_.setZero();
  V_.topRows(left.rows()) = left;
  if (directions.cols() == size) V_.leftCols(size).setZero();
}

// Measurements
// ---------------------------------------------------------------------------------------------------------

void ObservabilityMonitor::add_measurement(const LinearizedMeasurement& measurement) {
  apply_motion();
  std::vector<Part> parts;
  MeasurementMatrix R = measurement.R;
  for (int i = 0; i < measurement.part_count; ++i) {
    const MeasurementJacobian& H = measurement.parts[i].H;
    if (const auto noise = noises_.find(measurement.parts[i].block); noise != noises_.end()) {
      R += H * noise->second * H.transpose();
      continue;
    }
    parts.push_back({0, find_or_add(measurement.parts[i].block, static_cast<int>(H.cols())).first, H});
  }
  add_rows(parts, R);
}

void ObservabilityMonitor::augment(const BlockAugmentation& initialization) {
  apply_motion();
  const Eigen::Index errors = initialization.noise.rows();
  std::vector<Eigen::Index> measured;
  for (Eigen::Index i = 0; i < errors; ++i)
    if (std::any_of(initialization.parents.begin(), initialization.parents.end(),
                    [&](const BlockParent& parent) { return !parent.J.row(i).isZero(0); }))
      measured.push_back(i);
  const int first = find_or_add(initialization.block, static_cast<int>(errors)).first;
  for (std::size_t from = 0; from < measured.size();
       from += max_measurement_rows) {  // limit of rows per measurement
    const std::vector<Eigen::Index> some(
        measured.begin() + static_cast<std::ptrdiff_t>(from),
        measured.begin() +
            static_cast<std::ptrdiff_t>(std::min(measured.size(), from + max_measurement_rows)));
    const auto rows = static_cast<Eigen::Index>(some.size());
    const MatrixXd own = MatrixXd::Identity(errors, errors)(some, Eigen::all);
    std::vector<Part> parts{{0, first, own}};
    for (const BlockParent& parent : initialization.parents) {
      const MatrixXd J = parent.J(some, Eigen::all);
      parts.push_back({0, find_or_add(parent.block, static_cast<int>(J.cols())).first, -J});
    }
    MeasurementMatrix R = initialization.noise(some, some);
    for (std::size_t i = 0; i < some.size(); ++i)
      if (const auto copied = copied_error(initialization, some[i], blocks_.front().id);
          copied && *copied < position_size_)
        R.diagonal()[static_cast<Eigen::Index>(i)] = std::max(R.diagonal()[static_cast<Eigen::Index>(i)],
                                                              exact_position_sigma_ * exact_position_sigma_);
    R.diagonal().array() += 1e-14 * std::max(1e-14, R.trace() / static_cast<double>(rows));
    add_rows(parts, R);
  }
}

void ObservabilityMonitor::add_rows(const std::vector<Part>& parts, const MeasurementMatrix& R) {
  // Limit of pending rows: keeps time and memory linear in the measurements, also without motions
  constexpr int most_rows = 64;
  const Eigen::LLT<MeasurementMatrix> llt(R);
  if (llt.info() != Eigen::Success) return;  // the filter skips such a measurement
  if (!std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.H.allFinite(); })) {
    uncovered_ = Uncovered::not_finite;
    return;
  }
  for (const Part& part : parts) pending_.push_back({row_count_, part.first, llt.matrixL().solve(part.H)});
  row_count_ += static_cast<int>(R.rows());
  if (row_count_ >= most_rows) absorb_rows();
}

/// Triangularizes V and the pending rows, so that only V involves the vehicle.
void ObservabilityMonitor::absorb_rows() {
  if (row_count_ == 0) return;
  MatrixXd rows = MatrixXd::Zero(V_.rows() + row_count_, V_.cols());
  rows.topRows(V_.rows()) = V_;
  for (const Part& part : pending_)
    rows.block(V_.rows() + part.row, part.first, part.H.rows(), part.H.cols()) += part.H;
  pending_.clear();
  row_count_ = 0;
  put_rows(std::move(rows));
}

/// Computes V from arbitrary rows; the remaining rows, free of the vehicle, are added to the map.
void ObservabilityMonitor::put_rows(MatrixXd rows) {
  const int size = vehicle_errors();
  const Eigen::Index kept = std::min<Eigen::Index>(size, rows.rows());
  rows = turned_upright(std::move(rows), size);
  V_.setZero();
  V_.topRows(kept) = rows.topRows(kept);
  const auto of_map = rows.bottomRightCorner(rows.rows() - kept, rows.cols() - size);
  L_.add(of_map);
  if (of_map.rows() > 0) added_ += of_map.colwise().squaredNorm().transpose();
}

// Removal and replacement of blocks
// ---------------------------------------------------------------------------------------------------------

/// Splits L = rows' rows + rest, such that the rest does not involve the given errors; keeps the rest in L
/// and returns the rows over all errors. With the errors' own block B = F F': rows = F^+ (their rows of L).
MatrixXd ObservabilityMonitor::take_rows_of(int first, int count) {
  const int at = first - vehicle_errors();
  const MatrixXd own = L_.rows(at, count);
  const MatrixXd F = factor_of(own.middleCols(at, count));
  MatrixXd rows = MatrixXd::Zero(F.cols(), V_.cols());
  if (F.cols() == 0) return rows;
  auto of_map = rows.rightCols(own.cols());
  of_map = F.completeOrthogonalDecomposition().pseudoInverse() * own;
  L_.subtract(of_map);
  L_.set_rows(at, MatrixXd::Zero(count, own.cols()));
  return rows;
}

/// Marginalizes errors out; their columns remain, as zeros.
void ObservabilityMonitor::eliminate(int first, int count) {
  if (count == 0) return;
  absorb_rows();
  const MatrixXd taken = take_rows_of(first, count);
  MatrixXd rows(taken.rows() + V_.rows(), V_.cols());
  rows << taken, V_;
  const MatrixXd factors = rows.middleCols(first, count);
  rows = rows_without(factors, std::move(rows));
  rows.middleCols(first, count).setZero();
  put_rows(std::move(rows));
}

/// Removes the columns and rows of errors without information.
void ObservabilityMonitor::remove_columns(int first, int count) {
  if (count == 0) return;
  const Eigen::Index after = V_.cols() - first - count;
  const int at = first - vehicle_errors();
  V_.middleCols(first, after) = V_.rightCols(after).eval();
  V_.conservativeResize(Eigen::NoChange, first + after);
  L_.remove(at, count);
  added_.segment(at, after) = added_.tail(after).eval();
  added_.conservativeResize(at + after);
}

void ObservabilityMonitor::drop(BlockId id) {
  const Block* block = find(id);
  if (!block) return;
  eliminate(block->first, block->errors);
  shrink(*block, block->errors);
}

/// Removes the first errors of a block, which have no information left, or the whole block with its last error.
void ObservabilityMonitor::shrink(const Block& block, int by) {
  remove_columns(block.first, by);
  const auto at = blocks_.begin() + (&block - blocks_.data());
  for (auto later = at + 1; later != blocks_.end(); ++later) later->first -= by;
  at->errors -= by;
  if (at->errors > 0) return;
  index_of_.erase(at->id);
  for (auto later = blocks_.erase(at); later != blocks_.end(); ++later) --index_of_[later->id];
}

/// Substitutes these errors by C times the new ones.
void ObservabilityMonitor::transform_block(int first, int count, const MatrixXd& C) {
  const int at = first - vehicle_errors();
  V_.middleCols(first, count) = (V_.middleCols(first, count) * C).eval();
  MatrixXd L = C.transpose() * L_.rows(at, count);
  L.middleCols(at, count) = (L.middleCols(at, count) * C).eval();
  L_.set_rows(at, L);
  // |L_ij| <= sqrt(L_ii L_jj): (C' L C)_jj <= (sum of |C_ij| sqrt(L_ii))^2
  added_.segment(at, count) =
      (C.cwiseAbs().transpose() * added_.segment(at, count).cwiseSqrt()).cwiseAbs2().eval();
}

/// U' (new error) = (anything; T J (old error)) with U' = (B'; T), B spanning the noise. The old error is (T
/// J)^+ (T new) plus a vector of the null space of T J, which is marginalized out.
void ObservabilityMonitor::replace(const BlockReplacement& r) {
  const Block* block = find(r.block);
  if (!block) return;
  if (is_vehicle(*block)) return replace_vehicle(*block, r);
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

/// Of a vehicle, errors that follow from the old ones and the old from them: other changes are motions.
void ObservabilityMonitor::replace_vehicle(const Block& block, const BlockReplacement& r) {
  if (r.J.rows() != block.errors || !r.noise.isZero(0) || !can_be_undone(r.J, least_pivot)) {
    uncovered_ = Uncovered::other_block;
    return;
  }
  absorb_rows();
  apply_motion();
  V_.middleCols(block.first, block.errors) =
      (V_.middleCols(block.first, block.errors) * MatrixXd(r.J).inverse()).eval();
}

/// Old errors of the landmarks = new ones - B v, v of the vehicle. With rows R such that L B = R' R B and (L - R' R) B = 0,
/// the rest of L stays, and R (new errors - B v) are rows that involve the vehicle.
void ObservabilityMonitor::shear(const BlockShear& s) {
  const Block* vehicle = find(s.vehicle);
  if (!vehicle || s.landmarks.empty()) return;
  absorb_rows();
  apply_motion();
  const Eigen::Index columns = s.landmarks.front().B.cols(), all = vehicle_errors();
  MatrixXd B = MatrixXd::Zero(L_.size(), columns);
  for (const auto& [id, of_landmark] : s.landmarks)
    if (const Block* block = find(id)) B.middleRows(block->first - all, block->errors) = of_landmark;
  const Eigen::Index first = vehicle->first + s.first;
  V_.middleCols(first, columns) -= V_.rightCols(L_.size()) * B;
  const MatrixXd LB = L_.matrix() * B;
  const MatrixXd F = factor_of(B.transpose() * LB);
  if (F.cols() == 0) return;
  MatrixXd rows = MatrixXd::Zero(V_.rows() + F.cols(), V_.cols());
  rows.topRows(V_.rows()) = V_;
  const MatrixXd of_map = F.completeOrthogonalDecomposition().pseudoInverse() * LB.transpose();
  rows.bottomRightCorner(F.cols(), L_.size()) = of_map;
  L_.subtract(of_map);
  rows.block(V_.rows(), first, F.cols(), columns) = -F.transpose();
  const VectorXd added = added_;
  put_rows(std::move(rows));
  added_ = added;  // these rows were moved, not gained
}

MatrixXd ObservabilityMonitor::information() {
  absorb_rows();
  apply_motion();
  MatrixXd Y = V_.transpose() * V_;
  Y.bottomRightCorner(L_.size(), L_.size()) += L_.matrix();
  return Y;
}

VectorXd ObservabilityMonitor::gathered() {
  absorb_rows();
  apply_motion();
  VectorXd all = V_.colwise().squaredNorm().transpose();
  all.tail(L_.size()) += added_;
  return all;
}

}  // namespace incognita
