// Sweeps the allowed box in parallel lanes, whatever is seen there.
#pragma once

#include <vector>

#include "incognita/decision/action_rule.hpp"
#include "incognita/decision/approach.hpp"
#include "incognita/decision/route.hpp"

namespace incognita {

/// Uses the bounds of the settings and the estimated position. The lanes follow the longer side of the box and are swept from
/// the corner nearest to the start, layer by layer where the actions change the height, and then back.
class LawnMower final : public ActionRule {
 public:
  /// Throws std::invalid_argument for bounds that hold no lane, or more than 10000.
  LawnMower(const DecisionSettings& settings, const Mobility& mobility);

  int choose(const RuleInput& now, const std::vector<bool>& allowed) override;
  void forget() override { approach_.forget(); }
  void state(StateArchive& archive) override;

 private:
  WorldBounds bounds_;
  double lane_m_;
  Approach approach_;
  Route route_;
};

/// Both ends of all lanes, lane after lane, in the order of the sweep that starts nearest to `start`. Lanes lie in the middle of
/// strips that are at most `lane_m` wide and, with three axes, high.
std::vector<Eigen::Vector3d> lanes_of(const WorldBounds& bounds, double lane_m, int axes,
                                      const Eigen::Vector3d& start);

}  // namespace incognita
