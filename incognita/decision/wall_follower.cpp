#include "incognita/decision/wall_follower.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "incognita/decision/route_rule.hpp"

namespace incognita {
namespace {

void check_way_around(const DecisionSettings& s) {
  const Eigen::Vector2d size = (s.max_bound_m - s.min_bound_m).head<2>();
  if (!(size.minCoeff() > 2 * s.wall_distance_m) || !s.has_sides())
    throw std::invalid_argument(
        "decision.wall_distance_m: must be less than half of each side of the bounds in x and y, "
        "decision.min_bound_m to decision.max_bound_m, with decision.strategy = `wall-follower`");
}

/// Distances to the sides at -y, +x, +y, -x: counterclockwise.
std::array<double, 4> to_sides(const WorldBounds& bounds, const Eigen::Vector3d& p) {
  return {p.y() - bounds.min_m.y(), bounds.max_m.x() - p.x(), bounds.max_m.y() - p.y(),
          p.x() - bounds.min_m.x()};
}

std::size_t nearest_side(const WorldBounds& bounds, const Eigen::Vector3d& position) {
  const std::array<double, 4> distances = to_sides(bounds, position);
  return static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
}

}  // namespace

std::unique_ptr<ActionRule> wall_follower(const DecisionSettings& s, const Mobility& mobility) {
  check_way_around(s);
  const WorldBounds bounds{s.min_bound_m, s.max_bound_m};
  const auto plan = [bounds, distance_m = s.wall_distance_m](const Eigen::Vector3d& position, Route& route) {
    const Eigen::Vector3d min = bounds.min_m.array() + distance_m, max = bounds.max_m.array() - distance_m;
    const double z = position.z();
    const std::vector<Eigen::Vector3d> corners{
        {min.x(), min.y(), z}, {max.x(), min.y(), z}, {max.x(), max.y(), z}, {min.x(), max.y(), z}};
    const std::size_t side = nearest_side(bounds, position);
    route.start(corners, (side + 1) % corners.size(), corners[side]);
  };
  return std::make_unique<RouteRule>(bounds, mobility, plan);
}

}  // namespace incognita
