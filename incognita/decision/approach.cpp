#include "incognita/decision/approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

constexpr int planned = 3;
constexpr double most_plans = 1000;  // of large sets, fewer actions are planned
constexpr std::size_t most_stops =
    16;  // older ones are forgotten: they may stem from an error of the estimate
constexpr double outside_s_per_m = 100;  // leaving the bounds costs more than any detour
constexpr double near_s_per_m = 20;
constexpr double stopped_s = 30;  // for being where it was stopped

/// At least one.
int actions_ahead(int count) {
  int ahead = 1;
  while (ahead < planned && std::pow(count, ahead + 1) <= most_plans) ++ahead;
  return ahead;
}

}  // namespace

double reach_m(const Mobility& m) { return m.drives ? aim_ahead_m(m) / 2 : m.step_m; }

double aim_ahead_m(const Mobility& m) {
  return m.drives ? std::max(2 * m.step_m, m.speed_m_s / m.turn_rate_rad_s) : 1.25 * m.step_m;
}

double driven_heading(const BlockVector& state, const Mobility& m) {
  return heading_of(Eigen::Vector4d(state.segment<4>(3))) - m.yaw_rad;
}

void Approach::update(const BlockVector& state, const Surroundings& surroundings) {
  note_stop(position_in(state, mobility_));
  read_obstacles(state, surroundings);
}

/// The body was stopped if it covered less than half of the way of its action.
void Approach::note_stop(const Eigen::Vector3d& position) {
  if (!under_way_) return;
  const Leg leg = *under_way_;
  under_way_.reset();
  const Eigen::Vector3d way = leg.to - leg.from;
  if (way.isZero() || (position - leg.from).dot(way) > way.squaredNorm() / 2) return;
  stops_.push_back(leg.to);
  if (stops_.size() > most_stops) stops_.erase(stops_.begin());
}

/// As points at the middle of their cones. Those beyond the planned way do not matter.
void Approach::read_obstacles(const BlockVector& state, const Surroundings& surroundings) {
  obstacles_.clear();
  if (!(mobility_.clearance_m > 0) || surroundings.obstacles.empty()) return;
  const double heading = driven_heading(state, mobility_);
  const Eigen::Vector3d ahead(std::cos(heading), std::sin(heading), 0);
  const Eigen::Vector3d axle = position_in(state, mobility_) - mobility_.forward_m * ahead;
  const double farthest = mobility_.clearance_m + aim_ahead_m(mobility_) + 2 * mobility_.step_m;
  for (const ConeRange& cone : surroundings.obstacles) {
    const double towards = heading + cone.bearing_rad;
    if (cone.range_m < farthest)
      obstacles_.push_back(axle + cone.range_m * Eigen::Vector3d(std::cos(towards), std::sin(towards), 0));
  }
}

bool Approach::is_clear(const Eigen::Vector3d& position) const {
  const auto near = [&](const std::vector<Eigen::Vector3d>& points, double clearance_m) {
    return std::ranges::any_of(
        points, [&](const Eigen::Vector3d& point) { return (point - position).norm() < clearance_m; });
  };
  return !near(stops_, mobility_.step_m) && !near(obstacles_, mobility_.clearance_m);
}

Eigen::Vector3d Approach::clear_point(const Eigen::Vector3d& to, const Eigen::Vector3d& center) const {
  Eigen::Vector3d way = center - to;
  way.z() = 0;
  const double length = way.norm(), spacing = mobility_.step_m / 2;
  constexpr int most_tries = 20;
  for (int i = 0; i < most_tries && i * spacing <= length; ++i) {
    const Eigen::Vector3d point = i == 0 ? to : Eigen::Vector3d(to + i * spacing / length * way);
    if (is_clear(point)) return point;
  }
  return to;
}

double Approach::time_to_s(const BlockVector& state, const Eigen::Vector3d& to) const {
  const Eigen::Vector3d way = to - position_in(state, mobility_);
  const double distance = way.head(mobility_.axes).norm();
  if (!mobility_.drives) return distance / mobility_.speed_m_s;
  const double off = std::abs(wrap_angle(std::atan2(way.y(), way.x()) - driven_heading(state, mobility_)));
  // The direction to a point that is nearly reached means nothing
  return distance / mobility_.speed_m_s +
         std::min(1.0, distance / reach_m(mobility_)) * off / mobility_.turn_rate_rad_s;
}

bool Approach::was_stopped_at(const Eigen::Vector3d& position) const {
  return std::ranges::any_of(
      stops_, [&](const Eigen::Vector3d& stop) { return (stop - position).norm() < mobility_.step_m / 2; });
}

double Approach::penalty_s(const ActionOutcome& outcome) const {
  double least_m = mobility_.clearance_m;
  const Eigen::Vector3d position = position_in(outcome.state, mobility_);
  for (const Eigen::Vector3d& obstacle : obstacles_)
    least_m = std::min(least_m, (obstacle - position).norm());
  return outside_s_per_m * outcome.outside_m + near_s_per_m * (mobility_.clearance_m - least_m) +
         (was_stopped_at(position) ? stopped_s : 0);
}

/// Sum of the costs after each action of the best sequence, from a state on.
double Approach::least_cost_s(const ActionSet& action_set, const BlockVector& state, int actions,
                              const Cost& cost_s) const {
  if (actions == 0) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a < action_set.count(); ++a) {
    const ActionOutcome outcome = action_set.after(state, a);
    const double cost = cost_s(outcome.state) + penalty_s(outcome);
    if (cost < least)
      least = std::min(least, cost + least_cost_s(action_set, outcome.state, actions - 1, cost_s));
  }
  return least;
}

int Approach::choose(const RuleInput& now, const std::vector<bool>& allowed, const Cost& cost_s) {
  const Eigen::Vector3d from = position_in(now.state, mobility_);
  const int stay = now.action_set.stay(), later = actions_ahead(now.action_set.count()) - 1;
  int best = stay;
  double least = std::numeric_limits<double>::infinity();
  Leg chosen{from, from};
  for (int a = 0; a < now.action_set.count(); ++a) {
    if (!allowed[static_cast<std::size_t>(a)]) continue;
    const ActionOutcome outcome = now.action_set.after(now.state, a);
    const Eigen::Vector3d to = position_in(outcome.state, mobility_);
    if (a != stay && was_stopped_at(to)) continue;
    const double cost = cost_s(outcome.state) + penalty_s(outcome) +
                        least_cost_s(now.action_set, outcome.state, later, cost_s);
    constexpr double rounding = 1e-9;
    if (cost < least - rounding || (a == stay && cost <= least + rounding))
      least = cost, best = a, chosen.to = to;
  }
  if (mobility_.arrives) under_way_ = chosen;
  // What keeps it where it is may lie beside the way that it did not try
  if (best == stay && !stops_.empty()) stops_.erase(stops_.begin());
  return best;
}

}  // namespace incognita
