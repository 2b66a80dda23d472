// Applies interventions to the parts of a running loop, between two ticks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/decision/taken_over.hpp"
#include "incognita/world/disturbed_images.hpp"

namespace incognita {

/// The disturbances that a scenario's world can take, by the names of interventions.
std::vector<std::string> possible_disturbances(const Scenario& scenario);
/// Whether a person can drive the bodies.
bool can_be_taken_over(const Scenario& scenario);

class Interventions {
 public:
  /// Wraps the sensor and the strategy of the loop; both must outlive this. Without an intervention the run stays the
  /// same, bit by bit.
  Interventions(LoopParts& parts, const Scenario& scenario, InterventionSource& source);

  /// Applies what is due before the motion of this tick.
  void apply_due(const Tick& tick);
  /// The last tick that interventions were applied at.
  const Tick& tick() const { return tick_; }
  /// Those that were applied at it.
  const std::vector<Intervention>& taken() const { return taken_; }

  /// Nobody drives by hand any more.
  void give_back_all() { strategy_->give_back_all(); }
  /// Saves or restores the changes of settings; before the state of the strategy, which depends on them.
  void state(StateArchive& archive);

 private:
  void apply(const Intervention& intervention);
  void change(const ChangeDecision& change);
  void check_body(std::size_t body) const;

  LoopParts& parts_;
  InterventionSource& source_;
  DisturbedImages* images_;
  TakenOver* strategy_;
  std::size_t bodies_;
  bool has_images_, controlled_;
  std::vector<std::string> settings_;  ///< changes so far
  Tick tick_;
  std::vector<Intervention> taken_;
};

}  // namespace incognita
