#include "incognita/decision/frontier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_compared = 500;             // the nearest frontiers
constexpr int farthest_level = 24, farthest_high = 8;  // in half cells: of viewpoints from the body

constexpr int patch_cells = 3;  // from the middle of a patch to its edge
constexpr double most_of_a_patch = 0.5;

/// Ways to viewpoints, in half cells: away from what is to be seen, and up. The shortest first.
std::vector<Eigen::Vector2d> ways_to_viewpoints(int highest) {
  std::vector<Eigen::Vector2d> ways;
  for (int away = -farthest_level; away <= farthest_level; ++away)
    for (int up = -highest; up <= highest; ++up) ways.emplace_back(away, up);
  std::ranges::stable_sort(ways,
                           [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  return ways;
}

double heading_in(const BlockVector& state) { return heading_of(Eigen::Vector4d(state.segment<4>(3))); }

double bearing_of(const Eigen::Vector3d& way) { return std::atan2(way.y(), way.x()); }

GazeDirection gaze_in(const BlockVector& state) {
  return {heading_in(state), elevation_of(Eigen::Vector4d(state.segment<4>(3)))};
}

/// From the heading of a state to a direction, to the left.
double turn_rad(const BlockVector& state, const Eigen::Vector3d& way) {
  return wrap_angle(bearing_of(way) - heading_in(state));
}

}  // namespace

std::vector<Eigen::Vector3d> unseen_about(const ExplorationVolume& v, int cell) {
  std::vector<Eigen::Vector3d> centers{center_of(v, cell)};
  const Eigen::Vector3i n = v.cells, at(cell % n.x(), cell / n.x() % n.y(), cell / n.x() / n.y());
  const Eigen::Vector3i first = (at.array() - patch_cells).max(0),
                        last = (at.array() + patch_cells).min(n.array() - 1);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const int other = x + n.x() * (y + n.y() * z);
        const bool near = (Eigen::Vector3i(x, y, z) - at).squaredNorm() <= patch_cells * patch_cells;
        if (other != cell && near && !is_seen(v, other)) centers.push_back(center_of(v, other));
      }
  return centers;
}

std::vector<int> frontier_cells(const ExplorationVolume& v) {
  const Eigen::Vector3i n = v.cells;
  const std::array<int, 3> strides{1, n.x(), n.x() * n.y()};
  std::vector<int> unseen, beside;
  for (int cell = 0; cell < n.prod(); ++cell) {
    if (is_seen(v, cell)) continue;
    unseen.push_back(cell);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int count = n[static_cast<int>(axis)], at = cell / strides[axis] % count;
      if ((at > 0 && is_seen(v, cell - strides[axis])) ||
          (at + 1 < count && is_seen(v, cell + strides[axis]))) {
        beside.push_back(cell);
        break;
      }
    }
  }
  return beside.empty() ? unseen : beside;
}

Frontier::Frontier(const DecisionSettings& s, const Mobility& mobility)
    : bounds_{s.min_bound_m, s.max_bound_m},
      period_s_(s.period_s),
      max_elevation_rad_(mobility.drives ? 0 : s.max_elevation_rad),
      approach_(mobility) {
  if (!mobility.has_gaze)
    throw std::invalid_argument(
        "decision.strategy: `frontier` needs a free camera or a vehicle that carries one; take another");
  if (!(mobility.turn_rate_rad_s > 0))
    throw std::invalid_argument(
        std::string(mobility.drives ? "controller.max_turn_rate_rad_s" : "decision.gaze_rate_rad_s") +
        ": must be more than 0 with decision.strategy = `frontier`, which turns the gaze");
}

/// Whether the pursuit ended in this tick.
bool Frontier::drop_done(const RuleInput& now) {
  if (!pursuit_) return false;
  const ExplorationVolume& volume = *now.surroundings.seen;
  const bool exists = pursuit_->cell < volume.cells.prod(), seen = exists && is_seen(volume, pursuit_->cell);
  if (exists && !seen && now.t < pursuit_->until_t) return false;
  if (exists && !seen) given_up_.push_back(pursuit_->cell);
  pursuit_.reset();
  return true;
}

/// In which the camera would have a cell in the middle of its image, as far as its gaze rises and falls.
GazeDirection Frontier::direction_to(const Eigen::Vector3d& from, const Eigen::Vector3d& cell) const {
  const Eigen::Vector3d way = cell - from;
  const double elevation_rad = std::atan2(way.z(), way.head<2>().norm());
  return {bearing_of(way), std::clamp(elevation_rad, -max_elevation_rad_, max_elevation_rad_)};
}

bool Frontier::would_see(const RuleInput& now, const Eigen::Vector3d& from, const GazeDirection& gaze,
                         const Eigen::Vector3d& cell) const {
  BlockVector state = now.state;
  const int axes = approach_.mobility().axes;
  state.head(axes) = from.head(axes);
  state.segment<4>(3) =
      max_elevation_rad_ > 0
          ? gaze_at(gaze.heading_rad, gaze.elevation_rad)
          : turned_left(state.segment<4>(3), wrap_angle(gaze.heading_rad - heading_in(now.state)));
  return now.surroundings.in_view(state, cell);
}

/// The part of the turn towards a cell, that brings it to the middle of the image, after which it is in view; both axes turn at
/// once. Called for viewpoints.
double Frontier::turn_to_view_rad(const RuleInput& now, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& cell) const {
  const GazeDirection now_at = gaze_in(now.state), to = direction_to(from, cell);
  const double left_rad = wrap_angle(to.heading_rad - now_at.heading_rad);
  const double up_rad = max_elevation_rad_ > 0 ? to.elevation_rad - now_at.elevation_rad : 0;
  const auto sees_after = [&](double share) {
    return would_see(now, from,
                     {now_at.heading_rad + share * left_rad, now_at.elevation_rad + share * up_rad}, cell);
  };
  if (sees_after(0)) return 0;
  double too_little = 0, enough = 1;
  constexpr int halvings = 5;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (too_little + enough) / 2;
    (sees_after(middle) ? enough : too_little) = middle;
  }
  return enough * std::max(std::abs(left_rad), std::abs(up_rad));
}

/// Whether the first of a patch of cells and a share of them are in view when the body faces the first.
bool Frontier::would_see_share(const RuleInput& now, const Eigen::Vector3d& from,
                               const std::vector<Eigen::Vector3d>& patch, double share) const {
  const GazeDirection gaze = direction_to(from, patch.front());
  if (!would_see(now, from, gaze, patch.front())) return false;
  const auto seen = std::ranges::count_if(
      patch, [&](const Eigen::Vector3d& cell) { return would_see(now, from, gaze, cell); });
  return static_cast<double>(seen) >= share * static_cast<double>(patch.size());
}

/// The nearest viewpoint within `most_m`, on the line from the first cell through the body and, in space, above and below it.
std::optional<Eigen::Vector3d> Frontier::viewpoint_of(const RuleInput& now,
                                                      const std::vector<Eigen::Vector3d>& patch, double share,
                                                      double most_m) const {
  static const std::vector<Eigen::Vector2d> in_space = ways_to_viewpoints(farthest_high),
                                            on_ground = ways_to_viewpoints(0);
  const int axes = approach_.mobility().axes;
  const Eigen::Vector3d body = position_in(now.state, approach_.mobility());
  const double bearing = bearing_of(patch.front() - body), spacing = now.surroundings.seen->cell_m / 2;
  const Eigen::Vector3d away(-std::cos(bearing), -std::sin(bearing), 0);
  for (const Eigen::Vector2d& way : axes == 3 ? in_space : on_ground) {
    if (spacing * way.norm() > most_m) return std::nullopt;
    const Eigen::Vector3d from = body + spacing * (way.x() * away + way.y() * Eigen::Vector3d::UnitZ());
    const bool inside = (from - bounds_.min_m).head(axes).minCoeff() >= 0 &&
                        (bounds_.max_m - from).head(axes).minCoeff() >= 0;
    if (!way.isZero() && !(inside && approach_.is_clear(from))) continue;
    if (would_see_share(now, from, patch, share)) return from;
  }
  return std::nullopt;
}

/// The nearest frontiers that were not given up, in order.
std::vector<int> Frontier::candidates(const RuleInput& now) {
  const ExplorationVolume& volume = *now.surroundings.seen;
  std::vector<int> cells = frontier_cells(volume);
  std::erase_if(cells, [&](int cell) { return std::ranges::find(given_up_, cell) != given_up_.end(); });
  const Eigen::Vector3d body = now.state.head<3>();
  const auto nearer = [&](int a, int b) {
    const double to_a = (center_of(volume, a) - body).squaredNorm();
    const double to_b = (center_of(volume, b) - body).squaredNorm();
    return to_a != to_b ? to_a < to_b : a < b;
  };
  const std::size_t kept = std::min(most_compared, cells.size());
  std::ranges::partial_sort(cells, cells.begin() + static_cast<std::ptrdiff_t>(kept), nearer);
  cells.resize(kept);
  return cells;
}

void Frontier::select_among(const RuleInput& now, const std::vector<int>& cells, double share) {
  const Mobility& can = approach_.mobility();
  const Eigen::Vector3d body = position_in(now.state, can);
  double soonest_s = std::numeric_limits<double>::infinity();
  for (const int cell : cells) {
    const std::vector<Eigen::Vector3d> patch = unseen_about(*now.surroundings.seen, cell);
    const auto view = viewpoint_of(now, patch, share, soonest_s * can.speed_m_s);
    if (!view) continue;
    const double needed_s = std::max(turn_to_view_rad(now, *view, patch.front()) / can.turn_rate_rad_s,
                                     (*view - body).norm() / can.speed_m_s);
    if (needed_s >= soonest_s) continue;
    soonest_s = needed_s;
    constexpr double patience = 2, patience_periods = 10;
    pursuit_ = Pursuit{cell, *view, now.t + patience * needed_s + patience_periods * period_s_};
  }
}

/// If none is left, those that were given up are tried again at the next decision.
void Frontier::select(const RuleInput& now) {
  const std::vector<int> cells = candidates(now);
  select_among(now, cells, most_of_a_patch);
  if (!pursuit_) select_among(now, cells, 0);
  if (!pursuit_) given_up_.clear();
}

std::optional<GazeDirection> Frontier::gaze(const RuleInput& now) {
  if (drop_done(now) || (!pursuit_ && !faces_)) select(now);
  if (!pursuit_) return faces_ = faces_.value_or(gaze_in(now.state));
  return faces_ = direction_to(now.state.head<3>(), center_of(*now.surroundings.seen, pursuit_->cell));
}

/// The actions lead to the viewpoint only nearly: what is still out of view there is looked for from another one.
void Frontier::correct_viewpoint(const RuleInput& now) {
  const Eigen::Vector3d cell = center_of(*now.surroundings.seen, pursuit_->cell);
  const Eigen::Vector3d here = position_in(now.state, approach_.mobility());
  const bool there = (pursuit_->viewpoint - here).norm() < reach_m(approach_.mobility());
  if (!there || would_see(now, here, direction_to(here, cell), cell)) return;
  pursuit_->viewpoint = viewpoint_of(now, {cell}, 1, std::numeric_limits<double>::infinity()).value_or(here);
}

/// Of states on the way to the viewpoint of the pursued cell. A body that drives need not get there itself if it is on that side
/// of the cell: it faces the cell from as far.
Approach::Cost Frontier::cost_of(const RuleInput& now) const {
  const Mobility& can = approach_.mobility();
  const Eigen::Vector3d here = position_in(now.state, can), to = pursuit_ ? pursuit_->viewpoint : here;
  const Approach::Cost go_there = [this, to](const BlockVector& state) {
    return approach_.time_to_s(state, to);
  };
  if (!pursuit_ || !can.drives) return go_there;
  const Eigen::Vector3d cell = center_of(*now.surroundings.seen, pursuit_->cell);
  if ((to - cell).head<2>().dot((here - cell).head<2>()) < 0) return go_there;
  const double view_m = (cell - to).head<2>().norm();
  const bool nears = view_m < (cell - here).head<2>().norm();
  return [cell, view_m, nears, can](const BlockVector& state) {
    const Eigen::Vector3d way = cell - Eigen::Vector3d(state.head<3>());
    const double missing_m = (nears ? 1 : -1) * (way.head<2>().norm() - view_m);
    return std::max(0.0, missing_m) / can.speed_m_s + std::abs(turn_rad(state, way)) / can.turn_rate_rad_s;
  };
}

/// Whether the cell is out of view of a body that faces it and that no action leads nearer to a viewpoint.
bool Frontier::is_in_vain(const RuleInput& now) const {
  if (!pursuit_ || approach_.mobility().drives) return false;
  const Eigen::Vector3d cell = center_of(*now.surroundings.seen, pursuit_->cell);
  const Eigen::Vector3d camera = now.state.head<3>();
  constexpr double nearly_rad = 0.05;
  const GazeDirection at = gaze_in(now.state), to = direction_to(camera, cell);
  const bool faces = std::abs(wrap_angle(to.heading_rad - at.heading_rad)) < nearly_rad &&
                     (max_elevation_rad_ == 0 || std::abs(to.elevation_rad - at.elevation_rad) < nearly_rad);
  return faces && !would_see(now, position_in(now.state, approach_.mobility()), to, cell);
}

int Frontier::choose(const RuleInput& now, const std::vector<bool>& allowed) {
  drop_done(now);
  approach_.update(now);
  if (!pursuit_) select(now);
  if (pursuit_) correct_viewpoint(now);
  const int action = approach_.choose(now, allowed, cost_of(now));
  if (action == now.action_set.stay() && is_in_vain(now)) pursuit_->until_t = now.t;
  return action;
}

}  // namespace incognita
