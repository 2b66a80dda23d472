#include "incognita/belief/any_belief.hpp"

namespace incognita {

void AnyBelief::set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  std::visit([&](auto& b) { b.set_mean(id, mean); }, form_);
}

void AnyBelief::keep_trace(bool keep) {
  std::visit([&](auto& b) { b.keep_trace(keep); }, form_);
}

void AnyBelief::clear_trace() {
  std::visit([](auto& b) { b.clear_trace(); }, form_);
}

BlockMatrix AnyBelief::covariance(BlockId row, BlockId column) const {
  return std::visit([&](const auto& b) { return b.covariance(row, column); }, form_);
}

Eigen::MatrixXd AnyBelief::dense_covariance() const {
  return std::visit([](const auto& b) { return b.dense_covariance(); }, form_);
}

BlockId AnyBelief::add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                               const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  return std::visit([&](auto& b) { return b.add_vehicle(chart, mean, covariance); }, form_);
}

BlockId AnyBelief::augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                           std::span<const BlockParent> parents,
                           const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  return std::visit([&](auto& b) { return b.augment(chart, mean, parents, noise); }, form_);
}

void AnyBelief::replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                        const BlockMatrix& J, const BlockMatrix& noise) {
  std::visit([&](auto& b) { b.replace(id, chart, mean, J, noise); }, form_);
}

void AnyBelief::drop(BlockId id) {
  std::visit([&](auto& b) { b.drop(id); }, form_);
}

void AnyBelief::predict(const LinearizedMotion& motion) {
  std::visit([&](auto& b) { b.predict(motion); }, form_);
}

UpdateReport AnyBelief::update(std::span<const LinearizedMeasurement> measurements) {
  return std::visit([&](auto& b) { return b.update(measurements); }, form_);
}

bool AnyBelief::correction(std::span<const LinearizedMeasurement> measurements,
                           std::span<const BlockId> blocks, std::span<BlockVector> out) {
  return std::visit([&](auto& b) { return b.correction(measurements, blocks, out); }, form_);
}

void AnyBelief::innovation_covariance(std::span<const LinearizedMeasurement> measurements,
                                      Eigen::MatrixXd& S) const {
  std::visit([&](const auto& b) { b.innovation_covariance(measurements, S); }, form_);
}

void AnyBelief::change_frame(const LinearizedMotion& frame_motion,
                             std::span<const Belief::MovedBlock> others) {
  std::get<Belief>(form_).change_frame(frame_motion, others);
}

void AnyBelief::shear(BlockId vehicle, int first, std::span<const ErrorShear> landmarks) {
  std::get<Belief>(form_).shear(vehicle, first, landmarks);
}

void AnyBelief::decorrelate(Belief::Scope scope) { std::get<Belief>(form_).decorrelate(scope); }

bool AnyBelief::drops_correlations() const {
  const Belief* belief = std::get_if<Belief>(&form_);
  return belief && belief->correlations() == MapCorrelations::block_diagonal;
}

AnyBelief::BeforeNoise AnyBelief::before_noise(BlockId block) const {
  BeforeNoise before;
  before.block = block;
  if (const Belief* belief = std::get_if<Belief>(&form_)) {
    before.mean = belief->mean(block);
    before.covariance = belief->covariance(block);
    before.trace_size = belief->keeps_trace() ? belief->trace().size() : 0;
  } else {
    before.whole = std::get<InformationBelief>(form_);
  }
  return before;
}

void AnyBelief::take_noise_back(BeforeNoise before) {
  if (before.whole)
    form_ = std::move(*before.whole);
  else
    std::get<Belief>(form_).restore(before.block, before.mean, before.covariance, before.trace_size);
}

}  // namespace incognita
