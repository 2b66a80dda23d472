#include "incognita/decision/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/math/gaussian.hpp"

namespace incognita {
namespace {

void check(const ExplorationSettings& s) {
  if (s.expected_landmarks < 0) throw std::invalid_argument("fewer than no landmarks can not be expected");
  if (!(s.variance_expected_m2 > 0) || !std::isfinite(s.variance_expected_m2))
    throw std::invalid_argument("the variance of a landmark that is expected must be more than 0");
  if (!(s.cell_m > 0) || !(s.seen_s > 0))
    throw std::invalid_argument("cells and the time until they are seen must be more than 0");
  if (!s.min_m.allFinite() || !s.max_m.allFinite() || (s.max_m.array() <= s.min_m.array()).any())
    throw std::invalid_argument("the box that landmarks are expected in is empty");
  constexpr double most_cells = 1e6;
  if (((s.max_m - s.min_m) / s.cell_m).array().ceil().prod() > most_cells)
    throw std::invalid_argument("the box that landmarks are expected in has more than a million cells");
}

}  // namespace

Exploration::Exploration(const ExplorationSettings& settings, std::uint64_t seed)
    : settings_(settings), random_(seed, "decision.expected") {
  check(settings_);
  cells_ = ((settings_.max_m - settings_.min_m) / settings_.cell_m).array().ceil().max(1).cast<int>();
  unseen_cells_ = cells_.prod();
  seen_s_.assign(static_cast<std::size_t>(unseen_cells_), 0);
  renew_volume();
  for (int i = 0; i < settings_.expected_landmarks; ++i) {
    expected_.push_back(ExpectedLandmark{i});
    move_elsewhere(expected_.back());
  }
}

int Exploration::cell_of(const Eigen::Vector3d& position) const {
  const Eigen::Array3d share =
      (position - settings_.min_m).array() / (settings_.max_m - settings_.min_m).array();
  const Eigen::Array3i at =
      (share * cells_.cast<double>().array()).floor().cast<int>().max(0).min(cells_.array() - 1);
  return at.x() + cells_.x() * (at.y() + cells_.y() * at.z());
}

/// Moves the landmark to a position drawn uniformly in the unseen volume. Where nearly all is seen it may end in a seen cell, and is
/// moved again at the next update.
void Exploration::move_elsewhere(ExpectedLandmark& landmark) {
  const Eigen::Vector3d size = settings_.max_m - settings_.min_m;
  const auto draw = [&] {
    for (int i = 0; i < 3; ++i) landmark.position[i] = settings_.min_m[i] + size[i] * random_.uniform();
  };
  constexpr int most_draws = 10000;
  for (int i = 0; i < most_draws; ++i) {
    draw();
    if (!seen(cell_of(landmark.position))) return;
  }
}

void Exploration::renew_volume() {
  auto volume = std::make_shared<ExplorationVolume>(
      ExplorationVolume{settings_.min_m, settings_.max_m, settings_.cell_m, cells_, {}});
  volume->seen.assign((seen_s_.size() + 7) / 8, 0);
  for (std::size_t cell = 0; cell < seen_s_.size(); ++cell)
    if (seen(static_cast<int>(cell))) volume->seen[cell / 8] |= static_cast<std::uint8_t>(1u << cell % 8);
  volume_ = std::move(volume);
}

void Exploration::mark_seen(const std::function<bool(const Eigen::Vector3d&)>& in_view, double dt) {
  const int unseen_before = unseen_cells_;
  for (int cell = 0; cell < static_cast<int>(seen_s_.size()); ++cell) {
    double& s = seen_s_[static_cast<std::size_t>(cell)];
    if (s >= settings_.seen_s || !in_view(center_of(*volume_, cell))) continue;
    s += dt;
    // Rounding of the sum of dt must not decide whether a cell needs one more frame
    if (s > settings_.seen_s * (1 - 1e-9)) s = settings_.seen_s, --unseen_cells_;
  }
  if (unseen_cells_ != unseen_before) renew_volume();
}

void Exploration::update(const std::function<bool(const Eigen::Vector3d&)>& in_view, double dt, int mapped) {
  if (settings_.expected_landmarks == 0) return;
  mark_seen(in_view, dt);
  const auto left = static_cast<std::size_t>(std::max(0, settings_.expected_landmarks - mapped));
  if (unseen_cells_ == 0) return expected_.clear();
  // Landmarks in cells that were seen count as mapped first
  std::stable_partition(expected_.begin(), expected_.end(),
                        [&](const ExpectedLandmark& e) { return !seen(cell_of(e.position)); });
  while (expected_.size() > left) {
    mapped_.push_back(expected_.back());
    expected_.pop_back();
  }
  while (expected_.size() < left) {  // landmarks removed from the map are expected again where they were
    expected_.push_back(mapped_.back());
    mapped_.pop_back();
  }
  for (ExpectedLandmark& e : expected_)
    if (seen(cell_of(e.position))) move_elsewhere(e);
  std::sort(expected_.begin(), expected_.end(),
            [](const ExpectedLandmark& a, const ExpectedLandmark& b) { return a.index < b.index; });
}

double Exploration::coverage() const {
  return 1 - static_cast<double>(unseen_cells_) / static_cast<double>(seen_s_.size());
}

double entropy_of_unmapped(int count, double variance_m2, int dimensions) {
  return count * gaussian_entropy(dimensions * std::log(variance_m2), dimensions);
}

}  // namespace incognita
