// Next action of each body: the most informative one (thesis 6.2), body by body, each as if the others stood still.
// A free camera chooses translations and turns (6.3.1), a carried one its carrier's speed changes (6.4.2); vehicles on
// the ground or a line choose among the translations that they can execute.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/body_choice.hpp"
#include "incognita/decision/carrier_choice.hpp"
#include "incognita/decision/exploration.hpp"
#include "incognita/decision/plan/side_cells.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/decision/strategy.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {

class Decision final : public Strategy {
 public:
  /// One choice per body. `entropy`: whether the extended entropy is computed, which decides nothing. Throws
  /// std::invalid_argument without a choice and for invalid settings.
  Decision(std::vector<std::unique_ptr<BodyChoice>> choices, MapExpectation expectation,
           const ExplorationSettings& exploration = {}, std::uint64_t seed = 1, bool entropy = true);

  /// Scores the actions as the schedule asks; compares them and sets a new goal once per period. Actions that
  /// would end outside the bounds are scored but not chosen. A body that is lost chooses nothing.
  Goal choose(const Estimate& estimate, const Observation& observation, const Tick& tick) override;
  Goal choose(const Estimate& estimate, const Tick& tick) { return choose(estimate, {}, tick); }

  void restart(std::size_t body) override;
  void state(StateArchive& archive) override;
  /// Chooses by other settings from now on; what was seen and expected stays. Throws std::invalid_argument if the
  /// actions of a body would change, which are constant over a run.
  void change(std::vector<std::unique_ptr<BodyChoice>> choices);

  const std::vector<std::string>& actions(std::size_t body) const override {
    return choices_.at(body)->names();
  }

 private:
  void forget(std::size_t body);
  void explore(const Estimate& estimate, const Tick& tick);
  Surroundings surroundings_of(std::size_t body, const Estimate& estimate,
                               const Observation& observation) const;
  double since_last_call(const Tick& tick);

  std::vector<std::unique_ptr<BodyChoice>> choices_;
  MapExpectation expectation_;
  Exploration exploration_;
  std::optional<SideCells> sides_;
  bool entropy_;
  Goal goal_;
  std::optional<double> last_t_;         ///< s, of the last call
  std::optional<double> entropy_due_t_;  ///< s, next evaluation of the extended entropy
};

struct ActiveSettings {
  DecisionSettings decision = {};
  ExplorationSettings exploration = {};
  std::optional<CarrierSettings> carrier = {};  ///< vehicles that carry the cameras; empty for free cameras
  double tick_s = 0.1;                          ///< duration of one input
  double delay_s = 0;                           ///< after which an operator begins a chosen action
  int max_measurements = 1000;  ///< predicted measurements per point sensor; the most uncertain are kept
  std::uint64_t seed = 1;
};

/// The choices of all bodies of an estimator, for Decision::change().
std::vector<std::unique_ptr<BodyChoice>> choices_for(const SlamEstimator& estimator,
                                                     const ActiveSettings& settings);

/// For all bodies of an estimator, by all their sensors. Throws std::invalid_argument for invalid settings, a body
/// without a sensor, or a map in the frame of the vehicle.
std::unique_ptr<Decision> decide_for(const SlamEstimator& estimator, const ActiveSettings& settings = {});

}  // namespace incognita
