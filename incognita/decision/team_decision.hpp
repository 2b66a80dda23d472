// The next move of each vehicle of a team: the translation that teaches most (thesis 6.2), one vehicle after
// the other, each as if the others stood still.
#pragma once

#include <vector>

#include "incognita/decision/actions.hpp"
#include "incognita/decision/information.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/team_estimate.hpp"
#include "incognita/slam/team_settings.hpp"

namespace incognita {

struct TeamDecisionSettings {
  DecisionSettings decision;  ///< strategy `none`: there is nothing to decide
  double tick_s = 0.1;        ///< how long an input is held
  double max_range_m = 1e9;   ///< farther points are not expected to be seen
};

class TeamDecision {
 public:
  TeamDecision(TeamSettings team, const TeamDecisionSettings& settings);

  /// Compares all actions once per period and sets every vehicle's goal. Actions that would end outside the
  /// bounds are scored but not chosen. `scores` and `chosen` are the first vehicle's.
  Goal choose(const TeamEstimate& estimate, const Tick& tick);

  /// The translations that the team's motion has: along a line, on the plane, in space; "stay" is the last.
  const std::vector<Translation>& actions() const { return actions_; }

 private:
  struct Scored {
    std::vector<double> scores;
    std::size_t best = 0;
  };
  SmallVector after(const TeamEstimate& estimate, std::size_t vehicle, const Translation& action) const;
  Scored compare(const TeamEstimate& estimate, std::size_t vehicle);
  void expect_looks(const TeamEstimate& estimate, std::size_t vehicle, const SmallVector& state);
  bool allowed(const Eigen::Vector3d& place) const;

  TeamSettings team_;
  TeamDecisionSettings settings_;
  std::vector<Translation> actions_;
  Goal goal_;
  MutualInformation information_;
  std::vector<AffineLook> looks_;
};

}  // namespace incognita
