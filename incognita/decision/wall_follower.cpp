#include "incognita/decision/wall_follower.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

namespace incognita {
namespace {

void check(const DecisionSettings& s) {
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

double outward_heading(const WorldBounds& bounds, const Eigen::Vector3d& position) {
  return std::numbers::pi / 2 * (static_cast<double>(nearest_side(bounds, position)) - 1);
}

WallFollower::WallFollower(const DecisionSettings& s, const Mobility& mobility)
    : bounds_{s.min_bound_m, s.max_bound_m},
      distance_m_(s.wall_distance_m),
      approach_(mobility),
      route_(mobility) {
  check(s);
}

/// On the nearest side.
void WallFollower::start(const Eigen::Vector3d& position) {
  const Eigen::Vector3d min = bounds_.min_m.array() + distance_m_, max = bounds_.max_m.array() - distance_m_;
  const double z = position.z();
  const std::vector<Eigen::Vector3d> corners{
      {min.x(), min.y(), z}, {max.x(), min.y(), z}, {max.x(), max.y(), z}, {min.x(), max.y(), z}};
  const std::size_t side = nearest_side(bounds_, position);
  route_.start(corners, (side + 1) % corners.size(), corners[side]);
}

int WallFollower::choose(const RuleInput& now, const std::vector<bool>& allowed) {
  const Eigen::Vector3d position = position_in(now.state, approach_.mobility());
  if (!route_.started()) start(position);
  approach_.update(now);
  const Eigen::Vector3d to =
      approach_.clear_point(route_.next(position), (bounds_.min_m + bounds_.max_m) / 2);
  return approach_.choose(now, allowed,
                          [&](const BlockVector& state) { return approach_.time_to_s(state, to); });
}

}  // namespace incognita
