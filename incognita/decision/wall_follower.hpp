// Goes around along the sides of the allowed box, at a stated distance from them.
#pragma once

#include <vector>

#include "incognita/decision/action_rule.hpp"
#include "incognita/decision/approach.hpp"
#include "incognita/decision/route.hpp"

namespace incognita {

/// Uses the bounds of the settings and the estimated position; of obstacles what Approach knows. It goes counterclockwise as seen
/// from above, the sides on its right, at the height of the start.
class WallFollower final : public ActionRule {
 public:
  /// Throws std::invalid_argument if the bounds leave no way around.
  WallFollower(const DecisionSettings& settings, const Mobility& mobility);

  int choose(const RuleInput& now, const std::vector<bool>& allowed) override;
  void forget() override { approach_.forget(); }
  void state(StateArchive& archive) override;

 private:
  void start(const Eigen::Vector3d& position);

  WorldBounds bounds_;
  double distance_m_;
  Approach approach_;
  Route route_;
};

/// Heading that faces the nearest of the four upright sides of the bounds, rad; of equally near ones -y, +x, +y, -x.
double outward_heading(const WorldBounds& bounds, const Eigen::Vector3d& position);

}  // namespace incognita
