#include "incognita/decision/plan/planner.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace incognita {
namespace {

/// Thins the measurements of the map out, evenly; those that are expected stay.
void thin_out(std::vector<PredictedMeasurement>& measurements, int most) {
  const auto known = std::ranges::count_if(
      measurements, [](const auto& m) { return m.of != PredictedMeasurement::Of::unseen; });
  if (known <= most) return;
  int passed = 0, kept = 0;
  std::erase_if(measurements, [&](const PredictedMeasurement& m) {
    if (m.of == PredictedMeasurement::Of::unseen) return false;
    ++passed;
    if (kept * known >= passed * most) return true;
    ++kept;
    return false;
  });
}

int known_among(const std::vector<PredictedMeasurement>& measurements) {
  return static_cast<int>(std::ranges::count_if(
      measurements, [](const auto& m) { return m.of != PredictedMeasurement::Of::unseen; }));
}

}  // namespace

/// Those that are in view most often after the moves, held for one period and for all.
void Planner::take_landmarks(const Input& now) {
  std::map<BlockId, int> views;
  const auto look = [&](const BlockVector& state) {
    measurements_.clear();
    now.expectation.expect(state, measurements_);
    for (const PredictedMeasurement& m : measurements_)
      if (m.of == PredictedMeasurement::Of::mapped) ++views[m.block];
  };
  look(now.state);
  int periods = 0;
  for (const int held : settings_.held_periods) periods += held;
  for (int move = 0; move < now.moves.count(); ++move) {
    BlockVector state = now.state;
    for (int p = 0, m = move; p < periods; ++p, m = now.moves.then(m)) {
      state = now.moves.along(state, m, settings_.period_s);
      if (p == 0 || p == periods - 1) look(state);
    }
  }
  std::vector<std::pair<int, BlockId>> most;
  for (const auto& [block, count] : views) most.push_back({-count, block});
  std::ranges::sort(most);
  most.resize(std::min(most.size(), static_cast<std::size_t>(settings_.max_landmarks)));
  std::vector<BlockId> blocks;
  for (const auto& [count, block] : most) blocks.push_back(block);
  map_.start(now.estimate, now.body, blocks, now.expected, now.expected_var_m2);
}

Planner::Node Planner::after(const Input& now, const Node& from, int move, int periods) {
  Node node = from;
  const double between_s = settings_.period_s / settings_.views_per_period;
  for (int p = 0; p < periods; ++p, move = now.moves.then(move)) {
    const BlockVector begin = node.state;
    for (int v = 1; v <= settings_.views_per_period; ++v) {
      node.state = now.moves.along(begin, move, v * between_s);
      measurements_.clear();
      now.expectation.expect(node.state, measurements_);
      node.missing_matches += std::max(0, settings_.min_matches - known_among(measurements_));
      thin_out(measurements_, settings_.max_measured);
      node.map.predict(now.growth.A, now.growth.N);
      node.map.update(map_, measurements_);
    }
    node.outside_m = std::max(node.outside_m, now.moves.outside_m(node.state));
    node.blocked = node.blocked || !now.is_clear(node.state);
  }
  node.score = node.map.about_map(map_, settings_.resolution) -
               settings_.pose_weight * node.map.entropy_of_pose(settings_.resolution);
  ++evaluations_;
  return node;
}

/// The best ones first, as many as the evaluations that are left can expand.
void Planner::keep_best(std::vector<Node>& nodes, int levels_left, int moves) const {
  std::ranges::stable_sort(nodes, [](const Node& a, const Node& b) {
    return std::tuple(a.outside_m, a.blocked, a.missing_matches, -a.score) <
           std::tuple(b.outside_m, b.blocked, b.missing_matches, -b.score);
  });
  if (levels_left == 0) return;
  const int kept = std::max(1, (settings_.max_evaluations - evaluations_) / (moves * levels_left));
  if (kept < static_cast<int>(nodes.size())) nodes.erase(nodes.begin() + kept, nodes.end());
}

int Planner::choose(const Input& now) {
  const int moves = now.moves.count(), levels = static_cast<int>(settings_.held_periods.size());
  evaluations_ = 0;
  take_landmarks(now);
  const Node root{0, now.state, ImaginedMap(map_)};
  const double before = root.map.entropy_of_pose(settings_.resolution) * settings_.pose_weight;
  std::vector<Node> level, next;
  for (int move = 0; move < moves; ++move) {
    next.push_back(after(now, root, move, settings_.held_periods[0]));
    next.back().first = move;
  }
  scores_.clear();
  for (const Node& node : next) scores_.push_back(node.score + before);
  std::vector<bool> goes_on(static_cast<std::size_t>(moves), false);
  for (int depth = 1; depth < levels; ++depth) {
    keep_best(next, levels - depth, moves);
    std::swap(level, next);
    next.clear();
    for (const Node& node : level)
      for (int move = 0; move < moves; ++move)
        next.push_back(after(now, node, move, settings_.held_periods[static_cast<std::size_t>(depth)]));
  }
  keep_best(next, 0, moves);
  for (const Node& node : next) {
    const auto first = static_cast<std::size_t>(node.first);
    if (levels > 1 && (!goes_on[first] || node.score + before > scores_[first]))
      scores_[first] = node.score + before;
    goes_on[first] = true;
  }
  return next.front().first;
}

}  // namespace incognita
