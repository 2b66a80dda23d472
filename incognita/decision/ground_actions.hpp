// Translations of a vehicle on the ground or on a line: those of the action list that it can execute.
#pragma once

#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class GroundActions final : public ActionSet {
 public:
  /// `tick_s`: duration of one input; the error growth over the period is computed in steps of it, at rest.
  /// Throws std::invalid_argument if no action has zero displacement.
  GroundActions(const BodyModel& member, const std::vector<Translation>& actions, double period_s,
                double tick_s, const WorldBounds& bounds);
  int count() const override { return static_cast<int>(actions_.size()); }
  int stay() const override { return stay_; }
  /// A wheeled vehicle ends with the heading of its displacement.
  ActionOutcome after(const BlockVector& state, int action) const override;

  const std::vector<Translation>& actions() const { return actions_; }

 private:
  BodyModel member_;
  std::vector<Translation> actions_;
  double step_s_;
  int steps_;
  WorldBounds bounds_;
  int stay_;
};

}  // namespace incognita
