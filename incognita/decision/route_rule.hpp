// A rule that follows a closed route, planned when the first action is chosen.
#pragma once

#include <functional>

#include "incognita/decision/action_rule.hpp"
#include "incognita/decision/approach.hpp"
#include "incognita/decision/route.hpp"

namespace incognita {

/// Uses the bounds of the settings and the estimated position; of obstacles what Approach knows.
class RouteRule final : public ActionRule {
 public:
  /// Starts a route from where the body is.
  using Plan = std::function<void(const Eigen::Vector3d& position, Route& route)>;

  RouteRule(const WorldBounds& bounds, const Mobility& mobility, Plan plan);

  int choose(const RuleInput& now, const std::vector<bool>& allowed) override;
  void forget() override { approach_.forget(); }
  void state(StateArchive& archive) override;

 private:
  Eigen::Vector3d center_;  ///< of the bounds: it gives way to obstacles towards there
  Plan plan_;
  Approach approach_;
  Route route_;
};

}  // namespace incognita
