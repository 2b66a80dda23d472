#include "incognita/decision/route_rule.hpp"

#include <utility>

namespace incognita {

RouteRule::RouteRule(const WorldBounds& bounds, const Mobility& mobility, Plan plan)
    : center_((bounds.min_m + bounds.max_m) / 2),
      plan_(std::move(plan)),
      approach_(mobility),
      route_(mobility) {}

int RouteRule::choose(const RuleInput& now, const std::vector<bool>& allowed) {
  const Eigen::Vector3d position = position_in(now.state, approach_.mobility());
  if (!route_.started()) plan_(position, route_);
  approach_.update(now);
  const Eigen::Vector3d to = approach_.clear_point(route_.next(position), center_);
  return approach_.choose(now, allowed,
                          [&](const BlockVector& state) { return approach_.time_to_s(state, to); });
}

}  // namespace incognita
