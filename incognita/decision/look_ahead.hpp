// Which action teaches most, now or with those that may follow it: thesis 6.2, and beyond its one step.
#pragma once

#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/decision/expectation.hpp"
#include "incognita/decision/information_gain.hpp"
#include "incognita/decision/metric.hpp"

namespace incognita {

/// In the unit of the metric: nats, or for the Fisher traces the sum of inverse squares of m, rad and so on.
double value_of(const InformationGain& gain, Metric metric, int position_errors,
                const BlockMatrix& vehicle_given_map);

struct LookAheadSettings {
  Metric metric = Metric::state;
  int horizon = 1;             ///< actions one after the other; 1: the thesis' greedy choice
  int max_evaluations = 1000;  ///< sets of looks imagined in one comparison; the least is one for each action
  int position_errors = 3;     ///< the first errors of the vehicle, for Metric::position_and_map
};

class LookAhead {
 public:
  explicit LookAhead(const LookAheadSettings& settings);

  /// For each action what the best sequence that begins with it would teach. Sequences are followed level by
  /// level; of each level as many of the best are followed further as max_evaluations allows, at least one
  /// for every action that is allowed. Actions that are not allowed are told by themselves and followed no
  /// further. The belief is not touched.
  template <class Form>
  const std::vector<double>& scores(const Form& belief, BlockId vehicle, const BlockVector& state,
                                    const ActionSet& action_set, const Expectation& expectation);

  /// Of one action by itself.
  template <class Form>
  double score_of(const Form& belief, BlockId vehicle, const BlockVector& state, int action,
                  const ActionSet& action_set, const Expectation& expectation);

  /// Of each action, whether it is allowed.
  const std::vector<bool>& allowed() const { return allowed_; }
  int evaluations() const { return evaluations_; }  ///< of the last comparison

 private:
  struct Node {
    std::vector<int> actions;
    BlockVector state;
    double score = 0;
    bool allowed = true;
  };
  void evaluate(const ActionSet& action_set, const Expectation& expectation, const Node& from, int action,
                std::vector<Node>& into);
  void back_up_scores(int actions);
  void keep_best(int actions, int levels_left);
  void walk(const ActionSet& action_set, const Expectation& expectation, const BlockVector& state,
            const Node& to);

  LookAheadSettings settings_;
  InformationGain gain_;
  ImaginedStep step_;
  BlockMatrix given_map_;
  std::vector<Node> level_, next_;
  std::vector<double> scores_;
  std::vector<bool> allowed_, goes_on_;
  int evaluations_ = 0;
};

/// The best of what is allowed and a number; of equals "stay", for nothing is gained by moving, then the
/// first. "stay" where nothing is allowed.
int best_of(const std::vector<double>& scores, const std::vector<bool>& allowed, int stay);

}  // namespace incognita
