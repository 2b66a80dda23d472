#include "incognita/decision/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace incognita {

LookAhead::LookAhead(const LookAheadSettings& settings) : settings_(settings) {
  if (settings_.horizon < 1) throw std::invalid_argument("the horizon must be one action at least");
  if (settings_.max_evaluations < 1)
    throw std::invalid_argument("a comparison needs one evaluation at least");
  if (settings_.horizon > 1 && !is_of_sequences(settings_.metric))
    throw std::invalid_argument(
        "a horizon of more than one action needs the information of the whole state or of the vehicle");
}

const std::vector<double>& LookAhead::scores(const AnyBelief& belief, BlockId vehicle,
                                             const BlockVector& state, const ActionSet& action_set,
                                             const Expectation& expectation) {
  const int actions = action_set.count();
  evaluations_ = 0;
  if (settings_.metric == Metric::position_and_map) given_map_ = vehicle_given_map(belief, vehicle);
  gain_.start(belief, vehicle);
  scores_.assign(static_cast<std::size_t>(actions), 0);
  next_.clear();
  for (int a = 0; a < actions; ++a) evaluate(action_set, expectation, {{}, state, 0}, a, next_);
  allowed_.clear();
  for (const Node& node : next_) {
    scores_[static_cast<std::size_t>(node.actions[0])] = node.score;
    allowed_.push_back(node.allowed);
  }
  for (int depth = 2; depth <= settings_.horizon; ++depth) {
    keep_best(actions, settings_.horizon - depth + 1);
    next_.clear();
    for (const Node& node : level_) {
      walk(action_set, expectation, state, node);
      for (int a = 0; a < actions; ++a) evaluate(action_set, expectation, node, a, next_);
    }
    back_up_scores(actions);
  }
  return scores_;
}

double LookAhead::score_of(const AnyBelief& belief, BlockId vehicle, const BlockVector& state, int action,
                           const ActionSet& action_set, const Expectation& expectation) {
  evaluations_ = 0;
  if (settings_.metric == Metric::position_and_map) given_map_ = vehicle_given_map(belief, vehicle);
  gain_.start(belief, vehicle);
  next_.clear();
  evaluate(action_set, expectation, {{}, state, 0}, action, next_);
  return next_.front().score;
}

/// Sets the score of each first action to the best of next_; an action without successors keeps its score.
void LookAhead::back_up_scores(int actions) {
  goes_on_.assign(static_cast<std::size_t>(actions), false);
  for (const Node& node : next_) {
    const auto first = static_cast<std::size_t>(node.actions[0]);
    if (!goes_on_[first] || node.score > scores_[first]) scores_[first] = node.score;
    goes_on_[first] = true;
  }
}

/// Requires gain_ to stand at `from`. Actions that are not allowed are scored as the first of a sequence only.
void LookAhead::evaluate(const ActionSet& action_set, const Expectation& expectation, const Node& from,
                         int action, std::vector<Node>& into) {
  ActionOutcome outcome = action_set.after(from.state, action);
  const bool first = from.actions.empty();
  if (!outcome.allowed() && !first) return;
  step_.A = outcome.A;
  step_.N = outcome.N;
  expectation.expect(outcome.state, step_.measurements);
  gain_.push(step_);
  ++evaluations_;
  Node node{from.actions, outcome.state, gain_.of(settings_.metric, settings_.position_errors, given_map_),
            outcome.allowed()};
  gain_.pop();
  node.actions.push_back(action);
  into.push_back(std::move(node));
}

/// Keeps in level_ the nodes to expand: the best of each first action, then the best of the others.
void LookAhead::keep_best(int actions, int levels_left) {
  const int left = (settings_.max_evaluations - evaluations_) / (actions * levels_left);
  std::erase_if(next_, [](const Node& n) { return !n.allowed; });
  std::stable_sort(next_.begin(), next_.end(),
                   [](const Node& a, const Node& b) { return a.score > b.score; });
  std::vector<bool> begun(static_cast<std::size_t>(actions), false);
  const auto first_of_its_kind = [&](const Node& n) {
    const auto a = static_cast<std::size_t>(n.actions[0]);
    const bool first = !begun[a];
    begun[a] = true;
    return first;
  };
  const auto others = std::stable_partition(next_.begin(), next_.end(), first_of_its_kind);
  const auto kept = std::max<std::ptrdiff_t>(others - next_.begin(), left);
  next_.resize(std::min(next_.size(), static_cast<std::size_t>(kept)), Node{});
  std::swap(level_, next_);
}

void LookAhead::walk(const ActionSet& action_set, const Expectation& expectation, const BlockVector& state,
                     const Node& to) {
  while (gain_.steps() > 0) gain_.pop();
  BlockVector at = state;
  for (const int action : to.actions) {
    const ActionOutcome outcome = action_set.after(at, action);
    step_.A = outcome.A;
    step_.N = outcome.N;
    expectation.expect(outcome.state, step_.measurements);
    gain_.push(step_);
    at = outcome.state;
  }
}

int best_of(const std::vector<double>& scores, const std::vector<bool>& allowed, int stay) {
  int best = -1;
  for (int a = 0; a < static_cast<int>(scores.size()); ++a) {
    const auto i = static_cast<std::size_t>(a);
    if (!allowed[i] || !std::isfinite(scores[i])) continue;
    const bool better = best < 0 || scores[i] > scores[static_cast<std::size_t>(best)] ||
                        (a == stay && scores[i] == scores[static_cast<std::size_t>(best)]);
    if (better) best = a;
  }
  return best < 0 ? stay : best;
}

}  // namespace incognita
