#include "incognita/belief/state_layout.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

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

/// Throws std::invalid_argument with the concatenated parts, formatted only on failure because the loop must
/// not allocate.
template <class... Parts>
void require(bool ok, const Parts&... parts) {
  if (ok) return;
  std::ostringstream what;
  (what << ... << parts);
  throw std::invalid_argument(what.str());
}

/// Checks that a new mean fits its chart, and the chart the stack-allocated matrices.
void require_mean(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  require(chart.ambient() <= max_block_size, "a block has at most ", max_block_size, " numbers, this chart ",
          chart.ambient());
  require(mean.size() == chart.ambient(), "mean has ", mean.size(), " numbers, its chart ", chart.ambient());
}

}  // namespace

const StateLayout::Block& StateLayout::block(BlockId id) const {
  require(has(id), "no block ", id, " in the belief");
  return blocks_[index_of_[id]];
}

Eigen::Map<const Eigen::VectorXd> StateLayout::mean(BlockId id) const {
  const Block& b = block(id);
  return {mean_.data() + b.mean, b.chart.ambient()};
}

void StateLayout::set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const Block& b = block(id);
  require_mean(b.chart, mean);
  std::copy(mean.begin(), mean.end(), mean_.begin() + b.mean);
}

void StateLayout::check_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                                const Eigen::Ref<const Eigen::MatrixXd>& covariance) const {
  if (vehicles_ != block_count()) throw std::logic_error("vehicles must be added before the first landmark");
  require_mean(chart, mean);
  require(size_of(covariance) == Size{chart.tangent(), chart.tangent()}, "vehicle covariance is ",
          size_of(covariance), ", its chart has ", chart.tangent(), " errors");
}

void StateLayout::check_new_block(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                                  std::span<const BlockParent> parents,
                                  const Eigen::Ref<const Eigen::MatrixXd>& noise) const {
  const int size = chart.tangent();
  require_mean(chart, mean);
  require(size_of(noise) == Size{size, size}, "landmark noise is ", size_of(noise), ", its chart has ", size,
          " errors");
  for (const BlockParent& parent : parents) {
    const Size fits{size, block(parent.block).chart.tangent()};
    require(size_of(parent.J) == fits, "initialization Jacobian is ", size_of(parent.J), ", must be ", fits);
  }
}

void StateLayout::check_replacement(BlockId id, const Chart& chart,
                                    const Eigen::Ref<const Eigen::VectorXd>& mean, const BlockMatrix& J,
                                    const BlockMatrix& noise) const {
  const int old_size = block(id).chart.tangent(), size = chart.tangent();
  require_mean(chart, mean);
  require(size <= old_size, "a block cannot grow from ", old_size, " to ", size,
          " errors; drop it and augment");
  require(size_of(J) == Size{size, old_size} && size_of(noise) == Size{size, size}, "replacement of ",
          old_size, " errors by ", size, " does not fit: J ", size_of(J), ", noise ", size_of(noise));
}

void StateLayout::check(const LinearizedMotion& motion) const {
  const int size = block(motion.block).chart.tangent();
  require_mean(block(motion.block).chart, motion.x_next);
  require(size_of(motion.A) == Size{size, size} && size_of(motion.N) == Size{size, size}, "motion of block ",
          motion.block, " with ", size, " errors does not fit: A ", size_of(motion.A), ", N ",
          size_of(motion.N));
}

int StateLayout::check(std::span<const LinearizedMeasurement> measurements) const {
  int rows = 0;
  for (const LinearizedMeasurement& measurement : measurements) {
    require(size_of(measurement.R) == Size{measurement.rows(), measurement.rows()}, "measurement has ",
            measurement.rows(), " numbers, its noise is ", size_of(measurement.R));
    for (int i = 0; i < measurement.part_count; ++i) {
      const Size fits{measurement.rows(), block(measurement.parts[i].block).chart.tangent()};
      require(size_of(measurement.parts[i].H) == fits, "H for block ", measurement.parts[i].block, " is ",
              size_of(measurement.parts[i].H), ", must be ", fits);
    }
    rows += measurement.rows();
  }
  return rows;
}

BlockId StateLayout::append(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const BlockId id = static_cast<BlockId>(index_of_.size());
  index_of_.push_back(static_cast<int>(blocks_.size()));
  blocks_.push_back({id, chart, static_cast<int>(mean_.size()), errors_});
  const BlockVector copy = mean;  // `mean` may alias mean_
  mean_.insert(mean_.end(), copy.begin(), copy.end());
  errors_ += chart.tangent();
  return id;
}

BlockId StateLayout::append_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  ++vehicles_;
  return append(chart, mean);
}

void StateLayout::rechart(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const BlockVector copy = mean;  // `mean` may alias mean_, which changes below
  const std::size_t index = static_cast<std::size_t>(index_of_[id]);
  Block& b = blocks_[index];
  const int mean_by = chart.ambient() - b.chart.ambient(), error_by = chart.tangent() - b.chart.tangent();
  const auto at = mean_.begin() + b.mean;
  if (mean_by < 0) mean_.erase(at, at - mean_by);
  if (mean_by > 0) mean_.insert(at, mean_by, 0.0);
  std::copy(copy.begin(), copy.end(), mean_.begin() + b.mean);
  b.chart = chart;
  errors_ += error_by;
  for (std::size_t i = index + 1; i < blocks_.size(); ++i) {
    blocks_[i].mean += mean_by;
    blocks_[i].error += error_by;
  }
}

void StateLayout::forget(BlockId id) {
  const int index = index_of_[id];
  const Block b = blocks_[index];
  mean_.erase(mean_.begin() + b.mean, mean_.begin() + b.mean + b.chart.ambient());
  blocks_.erase(blocks_.begin() + index);
  index_of_[id] = -1;
  errors_ -= b.chart.tangent();
  if (index < vehicles_) --vehicles_;
  for (std::size_t i = index; i < blocks_.size(); ++i) {
    index_of_[blocks_[i].id] = static_cast<int>(i);
    blocks_[i].mean -= b.chart.ambient();
    blocks_[i].error -= b.chart.tangent();
  }
}

void StateLayout::shift_mean(std::span<const double> delta) {
  for (const Block& b : blocks_)
    b.chart.plus({mean_.data() + b.mean, static_cast<std::size_t>(b.chart.ambient())},
                 delta.subspan(b.error, b.chart.tangent()));
}

void StateLayout::keep_trace(bool keep) {
  if (keep == keeps_trace()) return;
  if (keep)
    trace_.emplace();
  else
    trace_.reset();
}

const BeliefTrace& StateLayout::trace() const {
  static const BeliefTrace nothing;
  return trace_ ? *trace_ : nothing;
}

void StateLayout::note(std::span<const LinearizedMeasurement> measurements) {
  if (trace_) trace_->insert(trace_->end(), measurements.begin(), measurements.end());
}

}  // namespace incognita
