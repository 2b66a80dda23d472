// A belief in covariance or information form, as chosen by the scenario, with the operations common to both.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "incognita/belief/belief.hpp"
#include "incognita/belief/information_belief.hpp"

namespace incognita {

class AnyBelief {
 public:
  AnyBelief() = default;  ///< covariance form
  explicit AnyBelief(Belief belief) : form_(std::move(belief)) {}
  explicit AnyBelief(InformationBelief belief) : form_(std::move(belief)) {}

  /// For operations of one form only: std::visit.
  const std::variant<Belief, InformationBelief>& form() const { return form_; }
  const StateLayout& layout() const {
    return std::visit([](const auto& b) -> const StateLayout& { return b; }, form_);
  }

  // As in belief.hpp and state_layout.hpp.

  int errors() const { return layout().errors(); }
  int block_count() const { return layout().block_count(); }
  bool has(BlockId id) const { return layout().has(id); }
  const Chart& chart(BlockId id) const { return layout().chart(id); }
  Eigen::Map<const Eigen::VectorXd> mean(BlockId id) const { return layout().mean(id); }
  int offset(BlockId id) const { return layout().offset(id); }
  void set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean);
  void keep_trace(bool keep);
  bool keeps_trace() const { return layout().keeps_trace(); }
  const BeliefTrace& trace() const { return layout().trace(); }
  void clear_trace();

  BlockMatrix covariance(BlockId row, BlockId column) const;
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  Eigen::MatrixXd dense_covariance() const;

  BlockId add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                      const Eigen::Ref<const Eigen::MatrixXd>& covariance);
  BlockId augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  std::span<const BlockParent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise);
  void replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
               const BlockMatrix& J, const BlockMatrix& noise);
  void drop(BlockId id);
  void predict(const LinearizedMotion& motion);
  UpdateReport update(std::span<const LinearizedMeasurement> measurements);
  bool correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                  std::span<BlockVector> out);
  void innovation_covariance(std::span<const LinearizedMeasurement> measurements, Eigen::MatrixXd& S) const;

  /// What adding noise to one block changes: a prediction with A = 1. In covariance form it is the mean and the covariance of
  /// that block alone, so that a large map need not be copied to take the prediction back.
  struct BeforeNoise {
    BlockId block = 0;
    BlockVector mean;
    BlockMatrix covariance;
    std::size_t trace_size = 0;
    std::optional<InformationBelief> whole;  ///< in information form, where all else changes, too
  };
  BeforeNoise before_noise(BlockId block) const;
  /// Takes such predictions of the block back, exactly, if nothing else changed the belief since before_noise().
  void take_noise_back(BeforeNoise before);

  // Covariance form only: in information form these throw std::bad_variant_access.

  void change_frame(const LinearizedMotion& frame_motion, std::span<const Belief::MovedBlock> others);
  void shear(BlockId vehicle, int first, std::span<const ErrorShear> landmarks);
  void decorrelate(Belief::Scope scope);
  /// True for a block-diagonal map covariance; false in information form.
  bool drops_correlations() const;

  /// Saves or restores all but the trace: math/saved_state/.
  void state(StateArchive& archive);

 private:
  std::variant<Belief, InformationBelief> form_;
};

}  // namespace incognita
