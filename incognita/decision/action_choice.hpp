// Which action is next, once a period: the strategies of thesis 6.3 and those they are compared with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incognita/decision/look_ahead.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/math/random.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

class ActionChoice {
 public:
  /// `names`: of the actions, in the order of the moves; `position_errors`: how many of the vehicle's first
  /// errors are its position; `who`: which vehicle of its team, so that each draws its own. Throws
  /// std::invalid_argument where the settings can not be, naming what is wrong.
  ActionChoice(const DecisionSettings& settings, std::vector<std::string> names, std::uint64_t seed,
               int position_errors = 3, std::size_t who = 0);

  /// Scores actions; once per period compares them. True when one was chosen in this tick.
  template <class Form>
  bool choose(const Form& belief, BlockId vehicle, const BlockVector& state, const ActionSet& action_set,
              const Expectation& expectation, const Tick& tick);

  /// After the estimate was lost, the next tick compares anew.
  void forget();

  const std::vector<double>& scores() const { return scores_; }  ///< of the last comparison; 0 before it
  int chosen() const { return chosen_; }                         ///< -1 before the first choice
  double end_t() const { return end_t_; }                        ///< s, when the action in force ends
  const std::vector<std::string>& names() const { return names_; }

 private:
  template <class Form>
  void score(const Form& belief, BlockId vehicle, const BlockVector& state, const ActionSet& action_set,
             const Expectation& expectation);
  void allow(const BlockVector& state, const ActionSet& action_set);
  int compare(const BlockVector& state, const ActionSet& action_set);
  int most_informative(const ActionSet& action_set) const;
  int any_allowed();
  int next_of_sequence(const ActionSet& action_set);

  DecisionSettings settings_;
  std::vector<std::string> names_;
  std::vector<int> sequence_;
  LookAhead look_ahead_;
  RandomStream random_, order_stream_;
  std::vector<double> scores_;
  std::vector<bool> allowed_;
  std::vector<double> outside_m_;
  std::vector<int> order_;  ///< `one-per-frame`: in which the actions are scored
  std::size_t scored_ = 0, taken_ = 0;
  int chosen_ = -1;
  double end_t_ = 0;
};

}  // namespace incognita
