// Information gain of each action, alone or as the first of a sequence: thesis 6.2, extended beyond one step.
#pragma once

#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/decision/expectation.hpp"
#include "incognita/decision/information_gain.hpp"
#include "incognita/decision/metric.hpp"

namespace incognita {

struct LookAheadSettings {
  Metric metric = Metric::state;
  int horizon = 1;             ///< length of the action sequences; 1: the greedy choice of the thesis
  int max_evaluations = 1000;  ///< sets of measurements predicted in one comparison; at least one per action
  /// Number of leading position errors of the vehicle, for Metric::position_and_map.
  int position_errors = 3;
};

class LookAhead {
 public:
  explicit LookAhead(const LookAheadSettings& settings);

  /// Scores each action by the best sequence that starts with it. Beam search: the tree is expanded level by level,
  /// and on each level as many of the best nodes are kept as max_evaluations permits, at least one per allowed first
  /// action. Actions that are not allowed are scored alone and not expanded. The belief is not changed.
  const std::vector<double>& scores(const AnyBelief& belief, BlockId vehicle, const BlockVector& state,
                                    const ActionSet& action_set, const Expectation& expectation);

  /// Score of one action alone.
  double score_of(const AnyBelief& belief, BlockId vehicle, const BlockVector& state, int action,
                  const ActionSet& action_set, const Expectation& expectation);

  /// For each action, whether it is allowed.
  const std::vector<bool>& allowed() const { return allowed_; }
  int evaluations() const { return evaluations_; }  ///< count of the last comparison

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

/// Best among the allowed actions with a finite score; ties go to `stay`, since moving gains nothing, then to
/// the first. Returns `stay` if none is allowed.
int best_of(const std::vector<double>& scores, const std::vector<bool>& allowed, int stay);

}  // namespace incognita
