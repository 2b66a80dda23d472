// Choice of the next action, once per period: the strategies of thesis 6.3 and the baselines they are compared with.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/action_rule.hpp"
#include "incognita/decision/look_ahead.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/math/random.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

class StateArchive;

class ActionChoice {
 public:
  /// `names`: names of the actions, in the order of the action set. `position_errors`: number of leading
  /// error components of the vehicle that are its position. `who`: index of the vehicle in its team; selects
  /// the random streams. `mobility`: for the strategies that are rules. Throws std::invalid_argument for
  /// invalid settings; the message names the setting.
  ActionChoice(const DecisionSettings& settings, std::vector<std::string> names, std::uint64_t seed,
               int position_errors = 3, std::size_t who = 0, const Mobility& mobility = {});

  /// Scores the actions; compares them once per period. Returns true if an action was chosen in this tick.
  bool choose(const AnyBelief& belief, BlockId vehicle, const BlockVector& state, const ActionSet& action_set,
              const Expectation& expectation, const Tick& tick, const Surroundings& surroundings = {});
  /// Where the strategy wants the camera to look in this tick; none if it does not choose that.
  std::optional<GazeDirection> gaze(const BlockVector& state, const ActionSet& action_set, const Tick& tick,
                                    const Surroundings& surroundings);

  /// To be called when tracking is lost: the next tick compares all actions again.
  void forget();

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

  /// Scores of the last comparison; 0 before the first.
  const std::vector<double>& scores() const { return scores_; }
  int chosen() const { return chosen_; }   ///< -1 before the first choice
  double end_t() const { return end_t_; }  ///< s, end of the current action
  const std::vector<std::string>& names() const { return names_; }

 private:
  void score(const AnyBelief& belief, BlockId vehicle, const BlockVector& state, const ActionSet& action_set,
             const Expectation& expectation);
  void allow(const BlockVector& state, const ActionSet& action_set);
  int compare(const RuleInput& now);
  int most_informative(const ActionSet& action_set) const;
  int any_allowed();
  int next_of_sequence(const ActionSet& action_set);

  DecisionSettings settings_;
  std::vector<std::string> names_;
  std::vector<int> sequence_;
  LookAhead look_ahead_;
  std::unique_ptr<ActionRule> rule_;  ///< null if the strategy is none
  RandomStream random_, order_stream_;
  std::vector<double> scores_;
  std::vector<bool> allowed_;
  std::vector<double> outside_m_;
  std::vector<int> order_;  ///< `one-per-frame`: order in which the actions are scored
  std::size_t scored_ = 0, taken_ = 0;
  int chosen_ = -1;
  double end_t_ = 0;
};

}  // namespace incognita
