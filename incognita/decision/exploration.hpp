// The part of the place that nobody has looked at yet, and the landmarks expected there: thesis 6.2,
// Figure 6.3.
//
// A box of the world is told in cells. A fixed number of landmarks is expected in it; those that are not
// mapped yet stand, at places drawn once, in cells that were not seen, each known so badly that it is as good
// as unknown. Looking at them would teach much, and this is what makes exploring pay: without them a map that
// is known well enough leaves nothing to learn.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/math/random.hpp"

namespace incognita {

struct ExpectedLandmark {
  int index = 0;  ///< which of them: the same for as long as it is expected
  Eigen::Vector3d position{0, 0, 0};
};

class Exploration {
 public:
  /// Throws std::invalid_argument where the box is empty, or a number cannot be.
  Exploration(const ExplorationSettings& settings, std::uint64_t seed);

  /// What is in view for `dt` seconds, and how many landmarks of the box are mapped. In cells that were seen
  /// nothing is expected any more: it is elsewhere, as long as there is an elsewhere.
  void update(const std::function<bool(const Eigen::Vector3d&)>& in_view, double dt, int mapped);

  /// Landmarks that are not mapped yet, at most expected_landmarks less what is mapped.
  const std::vector<ExpectedLandmark>& expected() const { return expected_; }
  /// Share of the box that was seen, 0 to 1.
  double coverage() const;
  const ExplorationSettings& settings() const { return settings_; }

 private:
  Eigen::Vector3d center_of(int cell) const;
  int cell_of(const Eigen::Vector3d& position) const;
  bool seen(int cell) const { return seen_s_[static_cast<std::size_t>(cell)] >= settings_.seen_s; }
  void move_elsewhere(ExpectedLandmark& landmark);

  ExplorationSettings settings_;
  Eigen::Vector3i cells_;
  std::vector<double> seen_s_;  ///< per cell
  std::vector<ExpectedLandmark> expected_;
  std::vector<ExpectedLandmark> mapped_;  ///< those that are taken to be mapped by now, in that order
  RandomStream random_;
  int unseen_cells_ = 0;
};

/// Entropy in nats of landmarks that are not mapped: what a map of fixed dimension (Figure 6.3) has beside
/// that of vehicle and map, so that runs with different maps can be compared. `dimensions`: of the place.
double entropy_of_unmapped(int count, double variance_m2, int dimensions = 3);

}  // namespace incognita
