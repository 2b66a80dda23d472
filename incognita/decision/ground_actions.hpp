// Translations of what stands on the ground or on a line: of the seven those along which it can go.
#pragma once

#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

class GroundActions final : public ActionSet {
 public:
  /// `tick_s`: how long an input is held; the error grows over the period in so many steps, at rest. Throws
  /// std::invalid_argument when none of the actions stays.
  GroundActions(const TeamMember& member, const std::vector<Translation>& actions, double period_s,
                double tick_s, const WorldBounds& bounds);
  int count() const override { return static_cast<int>(actions_.size()); }
  int stay() const override { return stay_; }
  /// A vehicle with wheels looks the way that it went.
  ActionOutcome after(const BlockVector& state, int action) const override;

  const std::vector<Translation>& actions() const { return actions_; }

 private:
  TeamMember member_;
  std::vector<Translation> actions_;
  double step_s_;
  int steps_;
  WorldBounds bounds_;
  int stay_;
};

}  // namespace incognita
