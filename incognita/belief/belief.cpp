#include "incognita/belief/belief.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "incognita/belief/rank_update.hpp"
#include "incognita/belief/rounding.hpp"

namespace incognita {
namespace {

struct Size {
  Eigen::Index rows, columns;
  bool operator==(const Size&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const Size& size) {
    return out << size.rows << "x" << size.columns;
  }
};

Size size_of(const auto& m) { return {m.rows(), m.cols()}; }

/// Throws what the parts spell. They are spelled only then, because the loop must not allocate.
template <class... Parts>
void require(bool ok, const Parts&... parts) {
  if (ok) return;
  std::ostringstream what;
  (what << ... << parts);
  throw std::invalid_argument(what.str());
}

/// A block that is about to be: its mean fits its chart, and both fit the matrices that live on the stack.
void require_mean(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  require(chart.ambient() <= max_block_size, "a block has at most ", max_block_size, " numbers, this chart ",
          chart.ambient());
  require(mean.size() == chart.ambient(), "mean has ", mean.size(), " numbers, its chart ", chart.ambient());
}

/// out[r] += sum over k < columns of h[k] * P[r + k * stride], for r < length.
template <int columns>
void add_columns(double* out, const double* P, long stride, const double* h, int length) {
  for (int r = 0; r < length; ++r) {
    double sum = h[0] * P[r];
    if constexpr (columns > 1) sum += h[1] * P[r + stride];
    if constexpr (columns > 2) sum += h[2] * P[r + 2 * stride];
    if constexpr (columns > 3) sum += h[3] * P[r + 3 * stride];
    out[r] += sum;
  }
}

void add_weighted_columns(double* out, const double* P, long stride, const double* h, int columns,
                          int length) {
  for (; columns >= 4; columns -= 4, P += 4 * stride, h += 4) add_columns<4>(out, P, stride, h, length);
  if (columns == 3) add_columns<3>(out, P, stride, h, length);
  if (columns == 2) add_columns<2>(out, P, stride, h, length);
  if (columns == 1) add_columns<1>(out, P, stride, h, length);
}

}  // namespace

Belief::Belief(int expected_errors, MapCorrelations correlations) : correlations_(correlations) {
  reserve(std::max(expected_errors, 1));
}

const Belief::Block& Belief::block(BlockId id) const {
  require(has(id), "no block ", id, " in the belief");
  return blocks_[index_of_[id]];
}

Eigen::Map<const Eigen::VectorXd> Belief::mean(BlockId id) const {
  const Block& b = block(id);
  return {mean_.data() + b.mean, b.chart.ambient()};
}

BlockMatrix Belief::covariance(BlockId row, BlockId column) const {
  const Block &a = block(row), &b = block(column);
  BlockMatrix m(a.chart.tangent(), b.chart.tangent());
  for (int j = 0; j < m.cols(); ++j)
    for (int i = 0; i < m.rows(); ++i) m(i, j) = entry(a.error + i, b.error + j);
  return m;
}

Eigen::MatrixXd Belief::dense_covariance() const { return P().selfadjointView<Eigen::Lower>(); }

void Belief::reserve(int errors) {
  if (errors <= capacity_) return;
  const int capacity = std::max(errors, capacity_ + capacity_ / 2);
  int stride = round_up_to_panel(capacity);
  if (stride % 512 == 0) stride += 8;  // columns a power of two apart would share cache sets
  AlignedBuffer grown(static_cast<std::size_t>(stride) * (capacity + 3));
  for (int j = 0; j < errors_; ++j)
    std::copy_n(storage_.data() + static_cast<long>(j) * stride_, errors_,
                grown.data() + static_cast<long>(j) * stride);
  storage_ = std::move(grown);
  stride_ = stride;
  capacity_ = capacity;
  delta_.resize(capacity);
  const int rank = std::exchange(rank_capacity_, 0);
  if (rank > 0) reserve_rank(rank);
}

void Belief::reserve_rank(int rank) {
  if (rank <= rank_capacity_) return;
  rank_capacity_ = rank;
  PHt_ = AlignedBuffer(static_cast<std::size_t>(stride_) * rank);
  packed_ = AlignedBuffer(static_cast<std::size_t>(stride_) * rank);
  S_.resize(rank, rank);
  residual_.resize(rank);
}

BlockId Belief::append(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const BlockId id = static_cast<BlockId>(index_of_.size());
  reserve(errors_ + chart.tangent());
  index_of_.push_back(static_cast<int>(blocks_.size()));
  blocks_.push_back({id, chart, static_cast<int>(mean_.size()), errors_});
  const BlockVector copy = mean;  // it may be a part of mean_
  mean_.insert(mean_.end(), copy.begin(), copy.end());
  errors_ += chart.tangent();
  return id;
}

BlockId Belief::add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                            const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  if (vehicles_ != block_count()) throw std::logic_error("vehicles must be added before the first landmark");
  if (vehicles_ == 1 && correlations_ == MapCorrelations::dropped)
    throw std::logic_error("dropped correlations: one vehicle, not more");
  require_mean(chart, mean);
  require(size_of(covariance) == Size{chart.tangent(), chart.tangent()}, "vehicle covariance is ",
          size_of(covariance), ", its chart has ", chart.tangent(), " errors");
  const int first = errors_;
  const BlockId id = append(chart, mean);
  ++vehicles_;
  P().bottomRows(chart.tangent()).leftCols(first).setZero();
  P().bottomRightCorner(chart.tangent(), chart.tangent()) = covariance;
  return id;
}

BlockId Belief::augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                        std::span<const Parent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  const int size = chart.tangent();
  require_mean(chart, mean);
  require(size_of(noise) == Size{size, size}, "landmark noise is ", size_of(noise), ", its chart has ", size,
          " errors");
  for (const Parent& parent : parents) {
    const Size fits{size, block(parent.block).chart.tangent()};
    require(size_of(parent.J) == fits, "birth Jacobian is ", size_of(parent.J), ", must be ", fits);
  }
  const int old = errors_;
  const BlockId id = append(chart, mean);
  Matrix p = P();
  // Cross covariance with all there was (2.24), then the block itself (2.25)
  for (int j = 0; j < old; ++j)
    for (int i = 0; i < size; ++i) {
      double sum = 0;
      for (const Parent& parent : parents) {
        const int from = block(parent.block).error;
        for (int k = 0; k < parent.J.cols(); ++k) sum += parent.J(i, k) * entry(from + k, j);
      }
      p(old + i, j) = sum;
    }
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) {
      double sum = 0.5 * (noise(i, j) + noise(j, i));
      for (const Parent& parent : parents) {
        const int from = block(parent.block).error;
        for (int k = 0; k < parent.J.cols(); ++k) sum += p(old + i, from + k) * parent.J(j, k);
      }
      p(old + i, old + j) = sum;
    }
  if (correlations_ == MapCorrelations::dropped) separate_newborn(blocks_.back());
  if (trace_) trace_->emplace_back(BlockBirth{id, {parents.begin(), parents.end()}, noise});
  return id;
}

void Belief::shift_offsets_after(std::size_t index, int mean_by, int error_by) {
  for (std::size_t i = index + 1; i < blocks_.size(); ++i) {
    blocks_[i].mean += mean_by;
    blocks_[i].error += error_by;
  }
}

/// Closes the gap of `count` rows and columns; what lies beyond the new size stays finite.
void Belief::remove_errors(int first, int count) {
  Matrix p = P();
  for (int j = 0; j < errors_; ++j) {
    if (j >= first && j < first + count) continue;
    const int below = std::max(first + count, j);  // above the diagonal nothing is worth moving
    const double* source = &p(0, j);
    std::copy(source + below, source + errors_, &p(below - count, j < first ? j : j - count));
  }
  errors_ -= count;
}

void Belief::replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                     const BlockMatrix& J, const BlockMatrix& noise) {
  const int old_size = block(id).chart.tangent(), size = chart.tangent();
  require_mean(chart, mean);
  require(size <= old_size, "a block cannot grow from ", old_size, " to ", size,
          " errors; drop it and augment");
  require(size_of(J) == Size{size, old_size} && size_of(noise) == Size{size, size}, "replacement of ",
          old_size, " errors by ", size, " does not fit: J ", size_of(J), ", noise ", size_of(noise));
  const BlockVector new_mean = mean;  // it may be a part of the mean that is about to move
  const int index = index_of_[id];
  Block& b = blocks_[index];
  Matrix p = P();
  const int first = b.error;
  const BlockMatrix own = J * covariance(id) * J.transpose() + noise;
  BlockVector column(size);
  for (int j = 0; j < first; ++j) {  // left of the block
    column.noalias() = J * p.col(j).segment(first, old_size);
    p.col(j).segment(first, size) = column;
  }
  for (int i = first + old_size; i < errors_; ++i) {  // below it
    column.noalias() = J * p.row(i).segment(first, old_size).transpose();
    p.row(i).segment(first, size) = column.transpose();
  }
  p.block(first, first, size, size) = own;
  if (old_size > size) remove_errors(first + size, old_size - size);
  const int mean_change = chart.ambient() - b.chart.ambient();
  if (mean_change < 0) mean_.erase(mean_.begin() + b.mean, mean_.begin() + b.mean - mean_change);
  if (mean_change > 0) mean_.insert(mean_.begin() + b.mean, mean_change, 0.0);
  std::copy(new_mean.begin(), new_mean.end(), mean_.begin() + b.mean);
  b.chart = chart;
  shift_offsets_after(index, mean_change, size - old_size);
  if (trace_) trace_->emplace_back(BlockReplacement{id, J, noise});
}

void Belief::drop(BlockId id) {
  const Block b = block(id);
  const int index = index_of_[id];
  remove_errors(b.error, b.chart.tangent());
  mean_.erase(mean_.begin() + b.mean, mean_.begin() + b.mean + b.chart.ambient());
  shift_offsets_after(index, -b.chart.ambient(), -b.chart.tangent());
  blocks_.erase(blocks_.begin() + index);
  index_of_[id] = -1;
  for (std::size_t i = index; i < blocks_.size(); ++i) index_of_[blocks_[i].id] = static_cast<int>(i);
  if (index < vehicles_) --vehicles_;
  note(BlockDrop{id});
}

void Belief::set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const Block& b = block(id);
  require_mean(b.chart, mean);
  std::copy(mean.begin(), mean.end(), mean_.begin() + b.mean);
}

void Belief::predict(const AffineMotion& motion) {
  const Block& b = block(motion.block);
  const int size = b.chart.tangent(), first = b.error, after = first + size;
  require_mean(b.chart, motion.x_next);
  require(size_of(motion.A) == Size{size, size} && size_of(motion.N) == Size{size, size}, "motion of block ",
          motion.block, " with ", size, " errors does not fit: A ", size_of(motion.A), ", N ",
          size_of(motion.N));
  Matrix p = P();
  const BlockMatrix own = motion.A * covariance(motion.block) * motion.A.transpose() + motion.N;
  BlockVector column(size);
  for (int j = 0; j < first; ++j) {  // vehicles before it
    column.noalias() = motion.A * p.col(j).segment(first, size);
    p.col(j).segment(first, size) = column;
  }
  // Everything below it, a few rows at a time so that they stay in the first cache
  constexpr int chunk = 64;
  Eigen::Matrix<double, chunk, max_block_size> rows;
  for (int i = after; i < errors_; i += chunk) {
    const int count = std::min(chunk, errors_ - i);
    rows.topLeftCorner(count, size).setZero();
    for (int k = 0; k < size; ++k) {
      const BlockVector weights = motion.A.row(k);
      add_weighted_columns(rows.col(k).data(), &p(i, first), stride_, weights.data(), size, count);
    }
    p.block(i, first, count, size) = rows.topLeftCorner(count, size);
  }
  p.block(first, first, size, size) = 0.5 * (own + own.transpose());
  std::copy(motion.x_next.begin(), motion.x_next.end(), mean_.begin() + b.mean);
  note(motion);
}

int Belief::check(std::span<const AffineLook> looks) const {
  int rows = 0;
  for (const AffineLook& look : looks) {
    require(size_of(look.R) == Size{look.rows(), look.rows()}, "look has ", look.rows(),
            " numbers, its noise is ", size_of(look.R));
    for (int i = 0; i < look.part_count; ++i) {
      const Size fits{look.rows(), block(look.parts[i].block).chart.tangent()};
      require(size_of(look.parts[i].H) == fits, "H for block ", look.parts[i].block, " is ",
              size_of(look.parts[i].H), ", must be ", fits);
    }
    rows += look.rows();
  }
  return rows;
}

/// H P, only the columns of one block.
LookJacobian Belief::times_covariance(const AffineLook& look, const Block& to) const {
  LookJacobian HP = LookJacobian::Zero(look.rows(), to.chart.tangent());
  for (int part = 0; part < look.part_count; ++part) {
    const LookJacobian& H = look.parts[part].H;
    const int from = block(look.parts[part].block).error;
    for (int j = 0; j < HP.cols(); ++j)
      for (int k = 0; k < H.cols(); ++k) {
        const double p = entry(from + k, to.error + j);
        for (int m = 0; m < H.rows(); ++m) HP(m, j) += H(m, k) * p;
      }
  }
  return HP;
}

template <class Destination>
void Belief::fill_innovation_covariance(std::span<const AffineLook> looks, Destination& S) const {
  int row = 0;
  for (std::size_t a = 0; a < looks.size(); ++a) {
    // Nearly all looks start with the vehicle that looked: its product is made once for all of them
    BlockId vehicle = 0;
    LookJacobian HP_vehicle;
    int column = 0;
    for (std::size_t b = 0; b <= a; ++b) {
      const AffineLook& other = looks[b];
      LookMatrix sum = LookMatrix::Zero(looks[a].rows(), other.rows());
      if (a == b) sum = looks[a].R;
      for (int part = 0; part < other.part_count; ++part) {
        const BlockId id = other.parts[part].block;
        const bool known = part == 0 && b > 0 && id == vehicle;
        const LookJacobian HP = known ? HP_vehicle : times_covariance(looks[a], block(id));
        sum += HP.lazyProduct(other.parts[part].H.transpose());
        if (part == 0 && !known) vehicle = id, HP_vehicle = HP;
      }
      S.block(row, column, sum.rows(), sum.cols()) = sum;
      if (a != b) S.block(column, row, sum.cols(), sum.rows()) = sum.transpose();
      column += other.rows();
    }
    row += looks[a].rows();
  }
}

void Belief::innovation_covariance(std::span<const AffineLook> looks, Eigen::MatrixXd& S) const {
  const int rows = check(looks);
  S.resize(rows, rows);
  fill_innovation_covariance(looks, S);
}

/// out[r, m] += H[m, :] * P[block, r] for the errors r up to the block's end, whose part of P lies along
/// rows.
void Belief::gather_above(const LookJacobian& H, const Block& b, double* out) const {
  const int size = b.chart.tangent(), rows = static_cast<int>(H.rows());
  const auto add = [&](int r, const double* p) {
    for (int m = 0; m < rows; ++m) {
      double sum = 0;
      for (int k = 0; k < size; ++k) sum += H(m, k) * p[k];
      out[r + static_cast<long>(m) * stride_] += sum;
    }
  };
  for (int r = 0; r < b.error; ++r) add(r, storage_.data() + b.error + static_cast<long>(r) * stride_);
  for (int r = b.error; r < b.error + size; ++r) {
    double p[max_block_size];
    for (int k = 0; k < size; ++k) p[k] = entry(r, b.error + k);
    add(r, p);
  }
}

/// The same for the errors [first, last) below the block, whose part of P lies along columns.
void Belief::gather_below(const LookJacobian& H, const Block& b, int first, int last, double* out) const {
  const int size = b.chart.tangent(), from = std::max(first, b.error + size);
  if (from >= last) return;
  const double* P_from = storage_.data() + from + static_cast<long>(b.error) * stride_;
  for (int m = 0; m < H.rows(); ++m) {
    const BlockVector weights = H.row(m);
    add_weighted_columns(out + from + static_cast<long>(m) * stride_, P_from, stride_, weights.data(), size,
                         last - from);
  }
}

/// P H', errors x rows. Below the blocks a few errors at a time, so that what all looks read stays in the
/// first cache.
void Belief::gather_PHt(std::span<const AffineLook> looks, int rank) {
  for (int m = 0; m < rank; ++m)
    std::fill_n(PHt_.data() + static_cast<long>(m) * stride_, round_up_to_panel(errors_), 0.0);
  const auto for_each_part = [&](const auto& work) {
    double* out = PHt_.data();
    for (const AffineLook& look : looks) {
      for (int i = 0; i < look.part_count; ++i) work(look.parts[i].H, block(look.parts[i].block), out);
      out += static_cast<long>(look.rows()) * stride_;
    }
  };
  for_each_part([&](const LookJacobian& H, const Block& b, double* out) { gather_above(H, b, out); });
  constexpr int chunk = 64;
  for (int i = 0; i < errors_; i += chunk)
    for_each_part([&](const LookJacobian& H, const Block& b, double* out) {
      gather_below(H, b, i, std::min(i + chunk, errors_), out);
    });
}

/// S = L L' into S_, L^-1 residual into residual_, and what the report says of them. False when S is not
/// positive.
bool Belief::factorise_innovation(std::span<const AffineLook> looks, UpdateReport& report) {
  report.rows = check(looks);
  reserve_rank(report.rows);
  auto S = S_.topLeftCorner(report.rows, report.rows);
  fill_innovation_covariance(looks, S);
  int row = 0;
  for (const AffineLook& look : looks) {
    residual_.segment(row, look.rows()) = look.residual;
    row += look.rows();
    const Eigen::LLT<LookMatrix> R(look.R);
    if (R.info() != Eigen::Success) return false;
    for (int i = 0; i < look.rows(); ++i) report.log_det_R += 2 * std::log(R.matrixLLT()(i, i));
  }
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(S);
  if (llt.info() != Eigen::Success || !residual_.head(report.rows).allFinite()) return false;
  for (int i = 0; i < report.rows; ++i)  // a pivot that is what rounding left of its row means nothing
    if (is_rounding(S(i, i) * S(i, i), S.row(i).head(i + 1).squaredNorm(), report.rows)) return false;
  report.log_det_S = 2 * S.diagonal().array().log().sum();
  if (!std::isfinite(report.log_det_S)) return false;
  for (int i = 0; i < report.rows; ++i) {  // forward substitution
    double sum = residual_[i];
    for (int k = 0; k < i; ++k) sum -= S(i, k) * residual_[k];
    residual_[i] = sum / S(i, i);
  }
  report.nis = residual_.head(report.rows).squaredNorm();
  return true;
}

void Belief::shift_mean(std::span<const double> delta) {
  for (const Block& b : blocks_)
    b.chart.plus({mean_.data() + b.mean, static_cast<std::size_t>(b.chart.ambient())},
                 delta.subspan(b.error, b.chart.tangent()));
}

/// delta = K * residual = W * (L^-1 residual). False when a variance would be lost, P being too much larger
/// than R.
bool Belief::compute_delta(int rank) {
  constexpr int lanes = rank_update_panel;
  for (int i = 0; i < errors_; ++i) {
    const double* w = packed_.data() + static_cast<long>(i / lanes) * lanes * rank + i % lanes;
    double sum = 0, taken = 0;
    for (int k = 0; k < rank; ++k) {
      sum += w[lanes * k] * residual_[k];
      taken += w[lanes * k] * w[lanes * k];
    }
    const double variance = entry(i, i);
    if (taken > 0 && is_rounding(variance - taken, variance, rank)) return false;
    delta_[i] = sum;
  }
  return true;
}

bool Belief::correction(std::span<const AffineLook> looks, std::span<const BlockId> blocks,
                        std::span<BlockVector> out) {
  if (correlations_ == MapCorrelations::dropped)
    throw std::logic_error("correction: looks are used one after the other where correlations are dropped");
  UpdateReport report;
  if (looks.empty() || !factorise_innovation(looks, report)) return false;
  auto y = residual_.head(report.rows);  // S^-1 residual
  S_.topLeftCorner(report.rows, report.rows).triangularView<Eigen::Lower>().transpose().solveInPlace(y);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    out[i] = BlockVector::Zero(block(blocks[i]).chart.tangent());
    int row = 0;
    for (const AffineLook& look : looks) {
      const LookVector of_look = y.segment(row, look.rows());
      for (int part = 0; part < look.part_count; ++part) {
        const BlockVector weighted = look.parts[part].H.transpose().lazyProduct(of_look);
        out[i] += covariance(blocks[i], look.parts[part].block).lazyProduct(weighted);
      }
      row += look.rows();
    }
  }
  return true;
}

UpdateReport Belief::update(std::span<const AffineLook> looks) {
  if (correlations_ == MapCorrelations::dropped) return update_dropping(looks);
  UpdateReport report;
  if (looks.empty()) return report;
  if (!factorise_innovation(looks, report)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  gather_PHt(looks, report.rows);
  // W = P H' L^-T
  whiten(PHt_.data(), stride_, errors_, S_.data(), static_cast<int>(S_.outerStride()), report.rows,
         packed_.data());
  if (!compute_delta(report.rows)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  rank_update(storage_.data(), stride_, errors_, packed_.data(), report.rows);
  shift_mean({delta_.data(), static_cast<std::size_t>(errors_)});
  report.outcome = UpdateReport::Outcome::updated;
  note(looks);
  return report;
}

void Belief::keep_trace(bool keep) {
  if (keep == keeps_trace()) return;
  if (keep)
    trace_.emplace();
  else
    trace_.reset();
}

const BeliefTrace& Belief::trace() const {
  static const BeliefTrace nothing;
  return trace_ ? *trace_ : nothing;
}

void Belief::note(std::span<const AffineLook> looks) {
  if (trace_) trace_->insert(trace_->end(), looks.begin(), looks.end());
}

}  // namespace incognita
