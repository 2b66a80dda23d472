#include "incognita/belief/belief.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/belief/rank_update.hpp"

namespace incognita {
namespace {

void require(bool ok, const std::string& what) {
  if (!ok) throw std::invalid_argument(what);
}

std::string size_of(const auto& m) { return std::to_string(m.rows()) + "x" + std::to_string(m.cols()); }

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

void add_weighted_columns(double* out, const double* P, long stride, const double* h, int columns, int length) {
  for (; columns >= 4; columns -= 4, P += 4 * stride, h += 4) add_columns<4>(out, P, stride, h, length);
  if (columns == 3) add_columns<3>(out, P, stride, h, length);
  if (columns == 2) add_columns<2>(out, P, stride, h, length);
  if (columns == 1) add_columns<1>(out, P, stride, h, length);
}

}  // namespace

Belief::Belief(int expected_errors) { reserve(std::max(expected_errors, 1)); }

const Belief::Block& Belief::block(BlockId id) const {
  if (!has(id)) throw std::invalid_argument("no block " + std::to_string(id) + " in the belief");
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
  mean_.insert(mean_.end(), mean.begin(), mean.end());
  errors_ += chart.tangent();
  return id;
}

BlockId Belief::add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                            const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  if (vehicles_ != block_count()) throw std::logic_error("vehicles must be added before the first landmark");
  require(mean.size() == chart.ambient(), "vehicle mean has " + std::to_string(mean.size()) +
                                              " numbers, its chart " + std::to_string(chart.ambient()));
  require(covariance.rows() == chart.tangent() && covariance.cols() == chart.tangent(),
          "vehicle covariance is " + size_of(covariance) + ", its chart has " + std::to_string(chart.tangent()) +
              " errors");
  require(chart.tangent() <= max_block_size, "a block has at most " + std::to_string(max_block_size) + " errors");
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
  require(mean.size() == chart.ambient(), "landmark mean has " + std::to_string(mean.size()) +
                                              " numbers, its chart " + std::to_string(chart.ambient()));
  require(noise.rows() == size && noise.cols() == size && size <= max_block_size,
          "landmark noise is " + size_of(noise) + ", its chart has " + std::to_string(size) + " errors");
  for (const Parent& parent : parents)
    require(parent.J.rows() == size && parent.J.cols() == block(parent.block).chart.tangent(),
            "birth Jacobian is " + size_of(parent.J) + ", does not fit its blocks");
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
    const double* source = &p(0, j);
    std::copy(source + first + count, source + errors_, &p(first, j < first ? j : j - count));
  }
  errors_ -= count;
}

void Belief::replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                     const BlockMatrix& J, const BlockMatrix& noise) {
  const int index = (block(id), index_of_[id]);
  Block& b = blocks_[index];
  const int old_size = b.chart.tangent(), size = chart.tangent();
  require(size <= old_size, "a block cannot grow from " + std::to_string(old_size) + " to " +
                                std::to_string(size) + " errors; drop it and augment");
  require(mean.size() == chart.ambient() && J.rows() == size && J.cols() == old_size && noise.rows() == size &&
              noise.cols() == size,
          "replacement does not fit: mean " + std::to_string(mean.size()) + ", J " + size_of(J) + ", noise " +
              size_of(noise));
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
  std::copy(mean.begin(), mean.end(), mean_.begin() + b.mean);
  b.chart = chart;
  shift_offsets_after(index, mean_change, size - old_size);
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
}

void Belief::set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const Block& b = block(id);
  require(mean.size() == b.chart.ambient(), "mean has " + std::to_string(mean.size()) + " numbers, the block " +
                                                std::to_string(b.chart.ambient()));
  std::copy(mean.begin(), mean.end(), mean_.begin() + b.mean);
}

void Belief::predict(const AffineMotion& motion) {
  const Block& b = block(motion.block);
  const int size = b.chart.tangent(), first = b.error, after = first + size;
  require(motion.x_next.size() == b.chart.ambient() && motion.A.rows() == size && motion.A.cols() == size &&
              motion.N.rows() == size && motion.N.cols() == size,
          "motion does not fit block " + std::to_string(motion.block));
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
}

template <class Destination>
void Belief::fill_innovation_covariance(std::span<const AffineLook> looks, Destination& S) const {
  int row = 0;
  for (std::size_t a = 0; a < looks.size(); ++a) {
    const AffineLook& look = looks[a];
    // H_a P restricted to the blocks of the looks b <= a, then times H_b'
    int column = 0;
    for (std::size_t b = 0; b <= a; ++b) {
      const AffineLook& other = looks[b];
      LookMatrix sum = a == b ? look.R : LookMatrix::Zero(look.rows(), other.rows());
      for (int i = 0; i < look.part_count; ++i)
        for (int j = 0; j < other.part_count; ++j) {
          const LookJacobian HP =
              look.parts[i].H * covariance(look.parts[i].block, other.parts[j].block);
          sum.noalias() += HP.lazyProduct(other.parts[j].H.transpose());
        }
      S.block(row, column, look.rows(), other.rows()) = sum;
      if (a != b) S.block(column, row, other.rows(), look.rows()) = sum.transpose();
      column += other.rows();
    }
    row += look.rows();
  }
}

void Belief::innovation_covariance(std::span<const AffineLook> looks, Eigen::MatrixXd& S) const {
  int rows = 0;
  for (const AffineLook& look : looks) rows += look.rows();
  S.resize(rows, rows);
  fill_innovation_covariance(looks, S);
}

/// P H', errors x rows, reading one triangle: below each block by columns, above it by rows.
void Belief::gather_PHt(std::span<const AffineLook> looks) {
  const auto out = [&](int column) { return PHt_.data() + static_cast<long>(column) * stride_; };
  int column = 0;
  for (const AffineLook& look : looks) {
    for (int m = 0; m < look.rows(); ++m) std::fill_n(out(column + m), round_up_to_panel(errors_), 0.0);
    for (int part = 0; part < look.part_count; ++part) {
      const LookJacobian& H = look.parts[part].H;
      const Block& b = block(look.parts[part].block);
      const int size = b.chart.tangent();
      for (int r = 0; r < b.error + size; ++r) {
        double p[max_block_size];
        if (r < b.error) {
          std::copy_n(storage_.data() + b.error + static_cast<long>(r) * stride_, size, p);
        } else {
          for (int k = 0; k < size; ++k) p[k] = entry(r, b.error + k);
        }
        for (int m = 0; m < look.rows(); ++m) {
          double sum = 0;
          for (int k = 0; k < size; ++k) sum += H(m, k) * p[k];
          out(column + m)[r] += sum;
        }
      }
    }
    column += look.rows();
  }
  constexpr int chunk = 64;
  for (int i = 0; i < errors_; i += chunk) {
    column = 0;
    for (const AffineLook& look : looks) {
      for (int part = 0; part < look.part_count; ++part) {
        const LookJacobian& H = look.parts[part].H;
        const Block& b = block(look.parts[part].block);
        const int size = b.chart.tangent();
        const int from = std::max(i, b.error + size), count = std::min(i + chunk, errors_) - from;
        if (count <= 0) continue;
        for (int m = 0; m < look.rows(); ++m) {
          const BlockVector weights = H.row(m);
          add_weighted_columns(out(column + m) + from, storage_.data() + from + static_cast<long>(b.error) * stride_,
                               stride_, weights.data(), size, count);
        }
      }
      column += look.rows();
    }
  }
}

/// S = L L' into S_, L^-1 residual into residual_, and what the report says of them. False when S is not positive.
bool Belief::factorise_innovation(std::span<const AffineLook> looks, UpdateReport& report) {
  report.rows = 0;
  report.log_det_R = 0;
  for (const AffineLook& look : looks) report.rows += look.rows();
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

/// W = P H' L^-T, eight rows at a time, straight into the panels that rank_update reads.
void Belief::whiten_and_pack(int rank) {
  constexpr int lanes = rank_update_panel;
  for (int i = 0; i < errors_; i += lanes) {
    double* panel = packed_.data() + static_cast<long>(i) * rank;
    for (int k = 0; k < rank; ++k) {
      double* w = panel + lanes * k;
      double sum[lanes];
      std::copy_n(PHt_.data() + static_cast<long>(k) * stride_ + i, lanes, sum);
      for (int l = 0; l < k; ++l) {
        const double factor = S_(k, l);
        const double* earlier = panel + lanes * l;
        for (int lane = 0; lane < lanes; ++lane) sum[lane] -= factor * earlier[lane];
      }
      const double inverse = 1 / S_(k, k);
      for (int lane = 0; lane < lanes; ++lane) w[lane] = sum[lane] * inverse;
    }
  }
}

void Belief::shift_mean(std::span<const double> delta) {
  for (const Block& b : blocks_)
    b.chart.plus({mean_.data() + b.mean, static_cast<std::size_t>(b.chart.ambient())},
                 delta.subspan(b.error, b.chart.tangent()));
}

UpdateReport Belief::update(std::span<const AffineLook> looks) {
  UpdateReport report;
  if (looks.empty()) return report;
  if (!factorise_innovation(looks, report)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  gather_PHt(looks);
  whiten_and_pack(report.rows);
  constexpr int lanes = rank_update_panel;
  for (int i = 0; i < errors_; ++i) {  // K * residual = W * (L^-1 residual)
    const double* w = packed_.data() + static_cast<long>(i / lanes) * lanes * report.rows + i % lanes;
    double sum = 0;
    for (int k = 0; k < report.rows; ++k) sum += w[lanes * k] * residual_[k];
    delta_[i] = sum;
  }
  rank_update(storage_.data(), stride_, errors_, packed_.data(), report.rows);
  shift_mean({delta_.data(), static_cast<std::size_t>(errors_)});
  report.outcome = UpdateReport::Outcome::updated;
  return report;
}

}  // namespace incognita
