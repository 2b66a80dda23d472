#include "incognita/decision/lawn_mower.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/decision/route_rule.hpp"

namespace incognita {
namespace {

int strips(double width_m, double lane_m) {
  constexpr double rounding = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(width_m / lane_m - rounding)));
}

void check_lanes(const DecisionSettings& s, int axes) {
  constexpr double most_lanes = 1e4;
  const Eigen::Vector3d size = s.max_bound_m - s.min_bound_m;
  const double rows = std::max(1.0, size.head<2>().minCoeff() / s.lane_m);
  const double layers = axes == 3 ? std::max(1.0, size.z() / s.lane_m) : 1;
  if (!(size.head(axes).minCoeff() > 0) || !s.has_sides() || !(rows * layers <= most_lanes))
    throw std::invalid_argument(
        "decision.lane_m: must divide the box from decision.min_bound_m to decision.max_bound_m into 10000 lanes "
        "at most, with decision.strategy = `lawn-mower`; give the bounds, or wider lanes");
}

}  // namespace

std::vector<Eigen::Vector3d> lanes_of(const WorldBounds& bounds, double lane_m, int axes,
                                      const Eigen::Vector3d& start) {
  const Eigen::Vector3d size = bounds.max_m - bounds.min_m, middle = (bounds.min_m + bounds.max_m) / 2;
  const int along = size.x() >= size.y() ? 0 : 1, across = 1 - along;
  const int rows = strips(size[across], lane_m), layers = axes == 3 ? strips(size.z(), lane_m) : 1;
  const auto in_strip = [&](int axis, int which, int count) {
    if (start[axis] > middle[axis]) which = count - 1 - which;
    return bounds.min_m[axis] + (which + 0.5) * size[axis] / count;
  };
  bool upwards = start[along] <= middle[along];
  std::vector<Eigen::Vector3d> points;
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < rows; ++i) {
      const int row = layer % 2 == 0 ? i : rows - 1 - i;
      Eigen::Vector3d from(0, 0, axes == 3 ? in_strip(2, layer, layers) : 0);
      from[across] = in_strip(across, row, rows);
      Eigen::Vector3d to = from;
      from[along] = upwards ? bounds.min_m[along] : bounds.max_m[along];
      to[along] = upwards ? bounds.max_m[along] : bounds.min_m[along];
      points.push_back(from);
      points.push_back(to);
      upwards = !upwards;
    }
  return points;
}

std::unique_ptr<ActionRule> lawn_mower(const DecisionSettings& s, const Mobility& mobility) {
  check_lanes(s, mobility.axes);
  const WorldBounds bounds{s.min_bound_m, s.max_bound_m};
  const auto plan = [bounds, lane_m = s.lane_m, axes = mobility.axes](const Eigen::Vector3d& position,
                                                                      Route& route) {
    std::vector<Eigen::Vector3d> points = lanes_of(bounds, lane_m, axes, position);
    for (std::size_t i = points.size() - 2; i > 0; --i) points.push_back(Eigen::Vector3d(points[i]));
    route.start(std::move(points), 0, position);
  };
  return std::make_unique<RouteRule>(bounds, mobility, plan);
}

}  // namespace incognita
