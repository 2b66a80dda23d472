// The blocks of a state, their order and their means: the part shared by covariance and information form.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "incognita/belief/linearized.hpp"
#include "incognita/belief/trace.hpp"
#include "incognita/math/chart.hpp"

namespace incognita {

class StateArchive;

class StateLayout {
 public:
  int errors() const { return errors_; }  ///< of all blocks
  int block_count() const { return static_cast<int>(blocks_.size()); }
  bool has(BlockId id) const { return index_of_.size() > id && index_of_[id] >= 0; }
  const Chart& chart(BlockId id) const { return block(id).chart; }
  /// Mean as stored: chart.ambient() numbers. Valid until the next change of the belief.
  Eigen::Map<const Eigen::VectorXd> mean(BlockId id) const;
  /// Index of a block's first error in the error vector.
  int offset(BlockId id) const { return block(id).error; }

  /// Sets a mean without changing its covariance, e.g. to stop a lost vehicle.
  void set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean);

  /// Switches recording of all changes on or off (default: off, at no cost).
  void keep_trace(bool keep);
  bool keeps_trace() const { return trace_.has_value(); }
  /// Changes since the trace was last cleared; empty when recording is off.
  const BeliefTrace& trace() const;
  void clear_trace() {
    if (trace_) trace_->clear();
  }

 protected:
  struct Block {
    BlockId id;
    Chart chart;
    int mean;   ///< index of its first number in mean_
    int error;  ///< index of its first error
  };

  const Block& block(BlockId id) const;

  /// Saves or restores blocks and means; not the trace, which is cleared between ticks.
  void layout_state(StateArchive& archive);

  // All checks throw std::invalid_argument, with the sizes, when sizes do not fit.
  void check_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                     const Eigen::Ref<const Eigen::MatrixXd>& covariance) const;
  void check_new_block(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                       std::span<const BlockParent> parents,
                       const Eigen::Ref<const Eigen::MatrixXd>& noise) const;
  void check_replacement(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                         const BlockMatrix& J, const BlockMatrix& noise) const;
  void check(const LinearizedMotion& motion) const;
  int check(std::span<const LinearizedMeasurement> measurements) const;  ///< total rows

  BlockId append(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean);
  BlockId append_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean);
  /// Replaces chart and mean of a block and shifts the blocks behind it.
  void rechart(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean);
  void forget(BlockId id);
  void shift_mean(std::span<const double> delta);

  void note(std::span<const LinearizedMeasurement> measurements);
  template <class Event>
  void note(const Event& event) {
    if (trace_) trace_->emplace_back(event);
  }

  std::vector<Block> blocks_;
  std::vector<int> index_of_;  ///< by id; -1 when dropped
  std::vector<double> mean_;
  int errors_ = 0;
  int vehicles_ = 0;
  std::optional<BeliefTrace> trace_;
};

}  // namespace incognita
