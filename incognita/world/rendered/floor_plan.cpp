#include "incognita/world/rendered/floor_plan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/math/angles.hpp"

namespace incognita {
namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

Point nearest_on(const std::array<Point, 2>& side, const Point& position) {
  const Point along = side[1] - side[0];
  const double share = (position - side[0]).dot(along) / along.squaredNorm();
  return side[0] + std::clamp(share, 0.0, 1.0) * along;
}

/// Ray parameter, in units of `direction`, at which a ray crosses an edge; infinite if it does not.
double crossing(const std::array<Point, 2>& side, const Point& position, const Point& direction) {
  const Point along = side[1] - side[0], to = side[0] - position;
  const double turn = cross(direction, along);
  const double t = cross(to, along) / turn, share = cross(to, direction) / turn;
  const bool meets = turn != 0 && t >= 0 && share >= 0 && share <= 1;
  return meets ? t : std::numeric_limits<double>::infinity();
}

}  // namespace

FloorPlan::FloorPlan(const RoomLayout& layout) : inside_(layout.inside), boxes_(layout.boxes) {
  std::vector<Box> all = boxes_;
  all.push_back(inside_);
  for (const Box& b : all) {
    const Point corners[] = {
        {b.min.x(), b.min.y()}, {b.max.x(), b.min.y()}, {b.max.x(), b.max.y()}, {b.min.x(), b.max.y()}};
    for (int i = 0; i < 4; ++i) sides_.push_back({corners[i], corners[(i + 1) % 4]});
  }
}

double FloorPlan::clearance_at(const Point& position) const {
  const auto covers = [&](const Box& box) {
    return (position.array() > box.min.head<2>().array()).all() &&
           (position.array() < box.max.head<2>().array()).all();
  };
  if (!covers(inside_) || std::any_of(boxes_.begin(), boxes_.end(), covers)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Side& side : sides_) least = std::min(least, (nearest_on(side, position) - position).norm());
  return least;
}

/// The nearest point of an edge inside a cone is its nearest point overall or where it leaves the cone.
double FloorPlan::clearance_towards(const Point& position, double direction_rad, double half_width_rad,
                                    double reach_m) const {
  double least = reach_m;
  for (const Side& side : sides_) {
    for (const double edge : {direction_rad - half_width_rad, direction_rad + half_width_rad})
      least = std::min(least, crossing(side, position, {std::cos(edge), std::sin(edge)}));
    const Point to = nearest_on(side, position) - position;
    if (std::abs(wrap_angle(std::atan2(to.y(), to.x()) - direction_rad)) <= half_width_rad)
      least = std::min(least, to.norm());
  }
  return least;
}

std::vector<ConeRange> measure_ranges(const FloorPlan& plan, const RangeRing& ring, const Point& position,
                                      double heading_rad) {
  const double half = std::numbers::pi / ring.cones;
  std::vector<ConeRange> out;
  for (int i = 0; i < ring.cones; ++i) {
    const double bearing = wrap_angle((2 * i + 1) * half);
    out.push_back(
        {bearing, half, plan.clearance_towards(position, heading_rad + bearing, half, ring.reach_m)});
  }
  return out;
}

}  // namespace incognita
