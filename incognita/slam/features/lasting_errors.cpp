#include "incognita/slam/features/lasting_errors.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "incognita/slam/features/feature.hpp"

namespace incognita {
namespace {

constexpr int blocks_per_landmark = 2;  // which landmarks are in view changes

Eigen::Matrix2d stationary_cov(const FilterSettings& settings, const Eigen::Matrix2d& plane_cov) {
  return std::pow(settings.sigma_lasting_px, 2) * Eigen::Matrix2d::Identity() + plane_cov;
}

/// A symmetric matrix with the absolute values of its eigenvalues.
Eigen::Matrix2d absolute(const Eigen::Matrix2d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(symmetric);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseAbs().asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace

void LastingErrors::start(Estimate& e, const FilterSettings& settings, int most_in_view) {
  slots_.clear();
  if (!(settings.sigma_lasting_px > 0)) return;
  slots_.resize(static_cast<std::size_t>(blocks_per_landmark * most_in_view));
  for (Slot& slot : slots_) {
    slot.block = e.belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(),
                                      stationary_cov(settings, slot.plane_cov));
    e.lasting_errors.push_back(slot.block);
  }
}

void LastingErrors::predict(Estimate& e, const FilterSettings& settings, double dt) const {
  const double left = std::exp(-dt / settings.lasting_time_s);
  for (const Slot& slot : slots_) {
    if (!slot.landmark) continue;
    const Eigen::Vector2d mean = left * e.belief.mean(slot.block);
    e.belief.predict({slot.block, mean, left * Eigen::Matrix2d::Identity(),
                      (1 - left * left) * stationary_cov(settings, slot.plane_cov)});
  }
}

void LastingErrors::lend(Estimate& e, const FilterSettings& settings, std::span<const FeatureMatch> matches) {
  if (slots_.empty()) return;
  ++frame_;
  for (const FeatureMatch& match : matches)
    if (match.outcome == MatchOutcome::matched)
      if (const auto at = index_of(match.id)) use_again(e, slots_[*at], match.plane_cov);
  for (const FeatureMatch& match : matches) {
    if (match.outcome != MatchOutcome::matched || index_of(match.id)) continue;
    Slot& slot = longest_unused();
    if (slot.used == frame_) return;  // more matches than blocks
    slot = {slot.block, match.id, frame_, match.plane_cov};
    e.belief.predict({slot.block, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero(),
                      stationary_cov(settings, match.plane_cov)});
  }
}

/// When more or less of the plane becomes known, or it is seen from elsewhere, the error changes by about as much at once.
void LastingErrors::use_again(Estimate& e, Slot& slot, const Eigen::Matrix2d& plane_cov) {
  const Eigen::Matrix2d change = absolute(plane_cov - slot.plane_cov);
  if (!change.isZero(0))
    e.belief.predict({slot.block, e.belief.mean(slot.block), Eigen::Matrix2d::Identity(), change});
  slot.used = frame_;
  slot.plane_cov = plane_cov;
}

void LastingErrors::take_back() {
  for (Slot& slot : slots_) slot.landmark.reset();
}

std::optional<BlockId> LastingErrors::of(std::int64_t landmark) const {
  const auto at = index_of(landmark);
  return at ? std::optional(slots_[*at].block) : std::nullopt;
}

std::optional<std::size_t> LastingErrors::index_of(std::int64_t landmark) const {
  const auto slot = std::ranges::find(slots_, landmark, &Slot::landmark);
  if (slot == slots_.end()) return std::nullopt;
  return static_cast<std::size_t>(slot - slots_.begin());
}

/// Blocks of no landmark first.
LastingErrors::Slot& LastingErrors::longest_unused() {
  return *std::ranges::min_element(slots_, {},
                                   [](const Slot& slot) { return slot.landmark ? slot.used : -1; });
}

}  // namespace incognita
