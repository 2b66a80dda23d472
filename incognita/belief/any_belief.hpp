// A belief in covariance or information form, as chosen by the scenario, with the operations common to both.
#pragma once

#include <Eigen/Core>
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
  void set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean) {
    std::visit([&](auto& b) { b.set_mean(id, mean); }, form_);
  }
  void keep_trace(bool keep) {
    std::visit([&](auto& b) { b.keep_trace(keep); }, form_);
  }
  bool keeps_trace() const { return layout().keeps_trace(); }
  const BeliefTrace& trace() const { return layout().trace(); }
  void clear_trace() {
    std::visit([](auto& b) { b.clear_trace(); }, form_);
  }

  BlockMatrix covariance(BlockId row, BlockId column) const {
    return std::visit([&](const auto& b) { return b.covariance(row, column); }, form_);
  }
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  Eigen::MatrixXd dense_covariance() const {
    return std::visit([](const auto& b) { return b.dense_covariance(); }, form_);
  }

  BlockId add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                      const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
    return std::visit([&](auto& b) { return b.add_vehicle(chart, mean, covariance); }, form_);
  }
  BlockId augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  std::span<const BlockParent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise) {
    return std::visit([&](auto& b) { return b.augment(chart, mean, parents, noise); }, form_);
  }
  void replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
               const BlockMatrix& J, const BlockMatrix& noise) {
    std::visit([&](auto& b) { b.replace(id, chart, mean, J, noise); }, form_);
  }
  void drop(BlockId id) {
    std::visit([&](auto& b) { b.drop(id); }, form_);
  }
  void predict(const LinearizedMotion& motion) {
    std::visit([&](auto& b) { b.predict(motion); }, form_);
  }
  UpdateReport update(std::span<const LinearizedMeasurement> measurements) {
    return std::visit([&](auto& b) { return b.update(measurements); }, form_);
  }
  bool correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                  std::span<BlockVector> out) {
    return std::visit([&](auto& b) { return b.correction(measurements, blocks, out); }, form_);
  }
  void innovation_covariance(std::span<const LinearizedMeasurement> measurements, Eigen::MatrixXd& S) const {
    std::visit([&](const auto& b) { b.innovation_covariance(measurements, S); }, form_);
  }

  // Covariance form only: in information form these throw std::bad_variant_access.

  void change_frame(const LinearizedMotion& frame_motion, std::span<const Belief::MovedBlock> others) {
    std::get<Belief>(form_).change_frame(frame_motion, others);
  }
  void shear(BlockId vehicle, int first, std::span<const ErrorShear> landmarks) {
    std::get<Belief>(form_).shear(vehicle, first, landmarks);
  }
  void decorrelate(Belief::Scope scope) { std::get<Belief>(form_).decorrelate(scope); }
  /// True for a block-diagonal map covariance; false in information form.
  bool drops_correlations() const {
    const Belief* belief = std::get_if<Belief>(&form_);
    return belief && belief->correlations() == MapCorrelations::block_diagonal;
  }

 private:
  std::variant<Belief, InformationBelief> form_;
};

}  // namespace incognita
