// Exploration prior: the unseen part of the exploration volume and the landmarks expected there (thesis 6.2,
// Figure 6.3).
//
// The volume is divided into cells and assumed to hold a fixed number of landmarks. Those not yet mapped are
// placed at random in unseen cells, with a variance so large that viewing them has a high expected gain.
// Without this prior a well-known map leaves no information to gain, and exploring would not pay.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "incognita/decision/settings.hpp"
#include "incognita/math/random.hpp"
#include "incognita/messages/exploration_volume.hpp"

namespace incognita {

class StateArchive;

struct ExpectedLandmark {
  int index = 0;  ///< identity, constant while it is expected
  Eigen::Vector3d position{0, 0, 0};
  Eigen::Vector3d normal{0, 0, 0};  ///< of the surface that it is expected on, inward; zero: on none
  double probability = 1;           ///< that there is a landmark to map
};

class Exploration {
 public:
  /// Throws std::invalid_argument if the volume is empty or a setting is out of range.
  Exploration(const ExplorationSettings& settings, std::uint64_t seed);

  /// Marks what is in view for `dt` seconds; `mapped`: number of landmarks mapped in the volume. Landmarks
  /// expected in cells that were seen are moved to unseen cells; if no cell is left, none is expected.
  void update(const std::function<bool(const Eigen::Vector3d&)>& in_view, double dt, int mapped);

  /// Landmarks not yet mapped: at most expected_landmarks less the number mapped.
  const std::vector<ExpectedLandmark>& expected() const { return expected_; }
  /// Fraction of the volume seen, 0 to 1.
  double coverage() const;
  /// The cells seen so far; the same object until another cell becomes seen.
  const std::shared_ptr<const ExplorationVolume>& volume() const { return volume_; }
  const ExplorationSettings& settings() const { return settings_; }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  int cell_of(const Eigen::Vector3d& position) const;
  bool seen(int cell) const { return seen_s_[static_cast<std::size_t>(cell)] >= settings_.seen_s; }
  void move_elsewhere(ExpectedLandmark& landmark);
  void mark_seen(const std::function<bool(const Eigen::Vector3d&)>& in_view, double dt);
  void renew_volume();

  ExplorationSettings settings_;
  Eigen::Vector3i cells_;
  std::vector<double> seen_s_;  ///< s in view, per cell
  std::vector<ExpectedLandmark> expected_;
  std::vector<ExpectedLandmark> mapped_;  ///< those counted as mapped so far, in that order
  RandomStream random_;
  int unseen_cells_ = 0;
  std::shared_ptr<const ExplorationVolume> volume_;
};

/// Entropy of unmapped landmarks, nats. It completes a map of fixed dimension (Figure 6.3), so that runs with
/// different maps are comparable. `dimensions`: of a landmark's position.
double entropy_of_unmapped(int count, double variance_m2, int dimensions = 3);

}  // namespace incognita
