#include "incognita/decision/action_choice.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

using Schedule = DecisionSettings::Schedule;

/// Whether actions are scored between decisions, too. Not all of them for a vehicle that stays whatever they score, as where a
/// recording is replayed.
bool scores_between_decisions(const DecisionSettings& s) {
  if (s.horizon > 1 || s.schedule == Schedule::at_decisions) return false;
  return s.schedule == Schedule::one_per_frame || s.strategy != DecisionSettings::Strategy::none;
}

std::vector<int> read_sequence(const std::string& text, const std::vector<std::string>& names) {
  std::vector<int> sequence;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto at = std::find(names.begin(), names.end(), word);
    if (at == names.end())
      throw std::invalid_argument("decision.sequence: `" + word +
                                  "` is none of the actions; the nearest is `" + nearest_name(word, names) +
                                  "`");
    sequence.push_back(static_cast<int>(at - names.begin()));
  }
  return sequence;
}

LookAheadSettings look_ahead_of(const DecisionSettings& s, int position_errors) {
  return {s.metric, s.horizon, s.max_evaluations, position_errors};
}

std::string stream_of(const std::string& name, std::size_t who) {
  return who == 0 ? name : name + "." + std::to_string(who);
}

}  // namespace

ActionChoice::ActionChoice(const DecisionSettings& settings, std::vector<std::string> names,
                           std::uint64_t seed, int position_errors, std::size_t who, const Mobility& mobility)
    : settings_(settings),
      names_(std::move(names)),
      sequence_(read_sequence(settings.sequence, names_)),
      look_ahead_(look_ahead_of(settings, position_errors)),
      rule_(make_rule(settings, mobility)),
      random_(seed, stream_of("decision.random", who)),
      order_stream_(seed, stream_of("decision.order", who)),
      scores_(names_.size(), 0),
      allowed_(names_.size(), false),
      order_(names_.size()) {
  if (settings_.strategy == DecisionSettings::Strategy::fixed_path && sequence_.empty())
    throw std::invalid_argument("decision.sequence: must name actions, decision.strategy being `fixed-path`");
  if (settings_.schedule == Schedule::one_per_frame && settings_.horizon > 1)
    throw std::invalid_argument("decision.horizon = " + std::to_string(settings_.horizon) +
                                ": must be 1 with decision.schedule = `one-per-frame`");
  std::iota(order_.begin(), order_.end(), 0);
}

void ActionChoice::forget() {
  if (rule_) rule_->forget();
  chosen_ = -1;
  scored_ = 0;
  std::fill(scores_.begin(), scores_.end(), 0);
}

bool ActionChoice::choose(const AnyBelief& belief, BlockId vehicle, const BlockVector& state,
                          const ActionSet& action_set, const Expectation& expectation, const Tick& tick,
                          const Surroundings& surroundings) {
  const bool due = chosen_ < 0 || has_come(end_t_, tick.t);
  if (due || scores_between_decisions(settings_)) score(belief, vehicle, state, action_set, expectation);
  if (!due) return false;
  chosen_ = compare({state, action_set, surroundings, tick.t});
  end_t_ = tick.t + settings_.period_s;
  return true;
}

std::optional<GazeDirection> ActionChoice::gaze(const BlockVector& state, const ActionSet& action_set,
                                                const Tick& tick, const Surroundings& surroundings) {
  return rule_ ? rule_->gaze({state, action_set, surroundings, tick.t}) : std::nullopt;
}

/// Scores are also computed for the strategies that do not use them, since they are recorded; for `none` at decisions only.
void ActionChoice::score(const AnyBelief& belief, BlockId vehicle, const BlockVector& state,
                         const ActionSet& action_set, const Expectation& expectation) {
  if (settings_.schedule != Schedule::one_per_frame) {
    scores_ = look_ahead_.scores(belief, vehicle, state, action_set, expectation);
    return;
  }
  const std::size_t turn = scored_++ % order_.size();
  if (turn == 0)
    for (std::size_t i = order_.size(); i > 1; --i)
      std::swap(order_[i - 1], order_[static_cast<std::size_t>(order_stream_.below(static_cast<int>(i)))]);
  const int action = order_[turn];
  scores_[static_cast<std::size_t>(action)] =
      look_ahead_.score_of(belief, vehicle, state, action, action_set, expectation);
}

/// Allows the actions with the smallest bound violation: if all violate, one must still be chosen, since a
/// driving vehicle cannot stop at once.
void ActionChoice::allow(const BlockVector& state, const ActionSet& action_set) {
  outside_m_.clear();
  for (int a = 0; a < action_set.count(); ++a) outside_m_.push_back(action_set.after(state, a).outside_m);
  const double least = *std::min_element(outside_m_.begin(), outside_m_.end());
  for (std::size_t a = 0; a < outside_m_.size(); ++a) allowed_[a] = outside_m_[a] <= least;
}

int ActionChoice::compare(const RuleInput& now) {
  allow(now.state, now.action_set);
  switch (settings_.strategy) {
    case DecisionSettings::Strategy::mutual_information:
      return most_informative(now.action_set);
    case DecisionSettings::Strategy::fixed_path:
      return next_of_sequence(now.action_set);
    case DecisionSettings::Strategy::lawn_mower:
    case DecisionSettings::Strategy::wall_follower:
    case DecisionSettings::Strategy::frontier:
      return rule_->choose(now, allowed_);
    case DecisionSettings::Strategy::random:
      return any_allowed();
    case DecisionSettings::Strategy::plan:  // planned_choice.hpp
    case DecisionSettings::Strategy::none:
      break;
  }
  return now.action_set.stay();
}

int ActionChoice::most_informative(const ActionSet& action_set) const {
  const auto stay = static_cast<std::size_t>(action_set.stay());
  // Until every action has a score it stays, if that is allowed
  const bool waits = settings_.schedule == Schedule::one_per_frame && scored_ < order_.size();
  return waits && allowed_[stay] ? action_set.stay() : best_of(scores_, allowed_, action_set.stay());
}

int ActionChoice::any_allowed() {
  std::vector<int> possible;
  for (std::size_t a = 0; a < allowed_.size(); ++a)
    if (allowed_[a]) possible.push_back(static_cast<int>(a));
  return possible[static_cast<std::size_t>(random_.below(static_cast<int>(possible.size())))];
}

/// An action that is not allowed is replaced by "stay", so that the rest of the sequence keeps its timing.
int ActionChoice::next_of_sequence(const ActionSet& action_set) {
  const int action = sequence_[taken_++ % sequence_.size()];
  return allowed_[static_cast<std::size_t>(action)] ? action : action_set.stay();
}

}  // namespace incognita
