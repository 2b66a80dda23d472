#include "incognita/decision/plan/planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

/// Thins the measurements of the map out, evenly. Those that are expected stay, and anchors: they inform on what all landmarks share.
void thin_out(std::vector<PredictedMeasurement>& measurements, int most) {
  const auto known = std::ranges::count_if(
      measurements, [](const auto& m) { return m.of == PredictedMeasurement::Of::mapped; });
  if (known <= most) return;
  int passed = 0, kept = 0;
  std::erase_if(measurements, [&](const PredictedMeasurement& m) {
    if (m.of != PredictedMeasurement::Of::mapped) return false;
    ++passed;
    if (kept * known >= passed * most) return true;
    ++kept;
    return false;
  });
}

/// `A` is linearized at rest. An error of the orientation is in the axes of the body, which turn, and it rotates the displacement:
/// without both, a turn of the world that body and map share would seem to be observable (slam/mapper/invariant_errors.hpp).
BlockMatrix along_the_way(const BlockMatrix& A, const BlockVector& before, const BlockVector& after) {
  constexpr int rotation = 3;  // first row of its errors
  const Eigen::Matrix3d R_before = rotation_matrix<double>(Eigen::Vector4d(before.segment<4>(3))),
                        R_after = rotation_matrix<double>(Eigen::Vector4d(after.segment<4>(3)));
  const Eigen::Vector3d way = after.head<3>() - before.head<3>();
  BlockMatrix out = A;
  out.topRows(3) -= skew(way) * R_before * A.middleRows(rotation, 3);
  out.middleRows(rotation, 3) = R_after.transpose() * R_before * A.middleRows(rotation, 3);
  return out;
}

int known_among(const std::vector<PredictedMeasurement>& measurements) {
  return static_cast<int>(std::ranges::count_if(
      measurements, [](const auto& m) { return m.of != PredictedMeasurement::Of::unseen; }));
}

}  // namespace

bool is_better(const PlanWorth& a, const PlanWorth& b) {
  const auto cost = [](const PlanWorth& w) {
    return std::isfinite(w.score) ? -w.score : std::numeric_limits<double>::infinity();
  };
  return std::tuple(a.outside_m, a.blocked, a.missing_matches, cost(a)) <
         std::tuple(b.outside_m, b.blocked, b.missing_matches, cost(b));
}

/// Those that are in view most often after the actions, held for one period and for all. Of many actions only every n-th is tried:
/// of the 63 of a free camera every seventh, so that each translation and each turn is among them. There are 3 or 9 turns, so n is
/// no multiple of 3.
void Planner::take_landmarks(const Input& now, const BlockVector& start) {
  std::map<BlockId, int> views;
  const auto look = [&](const BlockVector& state) {
    measurements_.clear();
    now.expectation.expect(state, measurements_);
    for (const PredictedMeasurement& m : measurements_)
      if (m.of == PredictedMeasurement::Of::mapped) ++views[m.block];
  };
  look(now.state);
  look(start);
  int periods = 0;
  for (const int held : settings_.held_periods) periods += held;
  constexpr int enough = 9;
  int step = std::max(1, now.actions.count() / enough);
  if (step % 3 == 0) --step;
  for (int action = 0; action < now.actions.count(); action += step) {
    BlockVector state = start;
    for (int p = 0, m = action; p < periods; ++p, m = now.actions.then(m)) {
      state = now.actions.along(state, m, settings_.period_s);
      if (p == 0 || p == periods - 1) look(state);
    }
  }
  std::vector<std::pair<int, BlockId>> most;
  for (const auto& [block, count] : views) most.push_back({-count, block});
  std::ranges::sort(most);
  most.resize(std::min(most.size(), static_cast<std::size_t>(settings_.max_landmarks)));
  std::vector<BlockId> blocks;
  for (const auto& [count, block] : most) blocks.push_back(block);
  map_.start(now.estimate, now.body, blocks, now.expected_var_m2, settings_.max_others);
}

/// The measurements from the state of the node update its covariance. `before`: the state at the view before.
void Planner::view(const Input& now, const BlockVector& before, Node& node) {
  measurements_.clear();
  now.expectation.expect(node.state, measurements_);
  node.worth.missing_matches += std::max(0, settings_.min_matches - known_among(measurements_));
  std::erase_if(measurements_, [&](const PredictedMeasurement& m) {
    return m.of == PredictedMeasurement::Of::mapped && map_.row_of(m.block) < 0;
  });
  thin_out(measurements_, settings_.max_measured);
  node.map.predict(along_the_way(now.growth.A, before, node.state), now.growth.N);
  node.map.update(map_, measurements_);
}

void Planner::rate(Node& node) const {
  node.worth.score = node.map.about_map(map_, settings_.resolution) +
                     node.map.about_expected(map_, unmapped_, settings_.resolution) -
                     settings_.pose_weight * node.map.entropy_of_pose(settings_.resolution);
  if (settings_.discount_s > 0)
    node.worth.score += information_to_go(node.state, unmapped_, map_, node.map, settings_.resolution,
                                          settings_.reach, node.t_s, settings_.discount_s);
}

Planner::Node Planner::after(const Input& now, const Node& from, int action, int periods) {
  Node node = from;
  const double between_s = settings_.period_s / settings_.views_per_period;
  for (int p = 0; p < periods; ++p, action = now.actions.then(action)) {
    const BlockVector begin = node.state;
    for (int v = 1; v <= settings_.views_per_period; ++v) {
      const BlockVector before = node.state;
      node.state = now.actions.along(begin, action, v * between_s);
      view(now, before, node);
    }
    node.worth.outside_m = std::max(node.worth.outside_m, now.actions.outside_m(node.state));
    node.worth.blocked = node.worth.blocked || !now.is_clear(node.state);
  }
  node.t_s += periods * settings_.period_s;
  rate(node);
  ++evaluations_;
  return node;
}

void Planner::begin(const Input& now, const std::optional<UnderWay>& under_way) {
  BlockVector start =
      under_way ? now.actions.along(now.state, under_way->action, under_way->left_s) : now.state;
  if (under_way && under_way->to) start.head<3>() = *under_way->to;
  take_landmarks(now, start);
  unmapped_.assign(now.unmapped.begin(), now.unmapped.end());
  root_ = Node{0, now.state, ImaginedMap(map_)};
  if (under_way) {
    const double between_s = settings_.period_s / settings_.views_per_period;
    const auto views = static_cast<int>(std::lround(under_way->left_s / between_s));
    for (int v = 1; v <= views; ++v) {
      const BlockVector before = root_->state;
      root_->state =
          v == views ? start : now.actions.along(now.state, under_way->action, v * under_way->left_s / views);
      view(now, before, *root_);
    }
    root_->state = start;
    root_->worth = {};
  }
  entropy_before_ = settings_.pose_weight * root_->map.entropy_of_pose(settings_.resolution);
  worths_.clear();
  level_.clear();
  evaluations_ = 0;
}

void Planner::imagine(const Input& now, int count) {
  const int actions = now.actions.count();
  map_.leave_out_moved(now.estimate);
  for (int i = 0; i < count && static_cast<int>(worths_.size()) < actions; ++i) {
    const auto action = static_cast<int>(worths_.size());
    Node node = after(now, *root_, action, settings_.held_periods.front());
    node.first = action;
    node.worth.score += entropy_before_;
    worths_.push_back(node.worth);
    if (goes_deeper()) level_.push_back(std::move(node));
  }
}

int Planner::choose(const Input& now) {
  imagine(now, now.actions.count());
  // What stops the body may have become known since an action was imagined
  for (std::size_t i = 0; i < worths_.size(); ++i)
    worths_[i].blocked =
        !now.is_clear(now.actions.along(root_->state, static_cast<int>(i), settings_.period_s));
  scores_.clear();
  for (const PlanWorth& worth : worths_) scores_.push_back(worth.score);
  const int best = goes_deeper()
                       ? choose_deeper(now)
                       : static_cast<int>(std::ranges::min_element(worths_, is_better) - worths_.begin());
  root_.reset();
  return best;
}

/// The best ones first, as many as the evaluations that are left can expand.
void Planner::keep_best(std::vector<Node>& nodes, int levels_left, int actions) const {
  std::ranges::stable_sort(nodes, is_better, &Node::worth);
  if (levels_left == 0) return;
  const int kept = std::max(1, (settings_.max_evaluations - evaluations_) / (actions * levels_left));
  if (kept < static_cast<int>(nodes.size())) nodes.erase(nodes.begin() + kept, nodes.end());
}

int Planner::choose_deeper(const Input& now) {
  const int actions = now.actions.count(), levels = static_cast<int>(settings_.held_periods.size());
  std::vector<bool> goes_on(static_cast<std::size_t>(actions), false);
  std::vector<Node> next = std::move(level_);
  for (int depth = 1; depth < levels; ++depth) {
    keep_best(next, levels - depth, actions);
    std::swap(level_, next);
    next.clear();
    for (const Node& node : level_)
      for (int action = 0; action < actions; ++action) {
        next.push_back(after(now, node, action, settings_.held_periods[static_cast<std::size_t>(depth)]));
        next.back().worth.score += entropy_before_;
      }
  }
  keep_best(next, 0, actions);
  for (const Node& node : next) {
    const auto first = static_cast<std::size_t>(node.first);
    if (!goes_on[first] || node.worth.score > scores_[first]) scores_[first] = node.worth.score;
    goes_on[first] = true;
  }
  level_.clear();
  return next.front().first;
}

}  // namespace incognita
