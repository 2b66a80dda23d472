// A plan of motion and gaze over several moves ahead: receding horizon, beam search.
//
// A plan is worth what is known at its end of the landmarks in reach and of the pose, to the resolution that the task needs:
// what is finer is worth nothing. Measurements are expected along the way, not only at its end, each with what the ones
// before have taught (imagined_map.hpp). A plan on which too few landmarks would be matched somewhere is a risk to lose track,
// and is chosen only if there is no other.
#pragma once

#include <functional>
#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/decision/expectation.hpp"
#include "incognita/decision/plan/imagined_map.hpp"
#include "incognita/decision/plan/moves.hpp"

namespace incognita {

struct PlannerSettings {
  /// Periods for which the moves of each level are held: the first is executed, the later ones are coarser.
  std::vector<int> held_periods{1, 2, 2};
  int views_per_period = 2;
  double period_s = 1;
  int max_evaluations = 300;  ///< moves imagined in one comparison; at least one per first move
  int max_landmarks = 48;     ///< of the map, that a plan follows
  int max_measured = 12;      ///< of the map, that a view corrects the imagined estimate by
  int min_matches = 8;        ///< of the map in every view; 0: no constraint
  double pose_weight = 1;
  Resolution resolution = {};
};

class Planner {
 public:
  explicit Planner(PlannerSettings settings) : settings_(std::move(settings)) {}

  struct Input {
    const Estimate& estimate;
    std::size_t body;
    const BlockVector& state;  ///< of the body, as the moves take it
    const MoveSet& moves;
    const Growth& growth;  ///< over the time between two views
    const Expectation& expectation;
    int expected;  ///< landmarks, and their variance, as the expectation predicts them
    double expected_var_m2;
    std::function<bool(const BlockVector& state)> is_clear;  ///< of obstacles that are known
  };

  /// The first move of the best plan.
  int choose(const Input& now);
  /// Nats by first move: of the best plan that begins with it, or of the move alone where no plan went on from it.
  const std::vector<double>& scores() const { return scores_; }
  int evaluations() const { return evaluations_; }

 private:
  struct Node {
    int first = 0;
    BlockVector state;
    ImaginedMap map;
    int missing_matches = 0;  ///< summed over its views
    double outside_m = 0;
    bool blocked = false;
    double score = 0;
  };
  void take_landmarks(const Input& now);
  Node after(const Input& now, const Node& from, int move, int periods);
  void keep_best(std::vector<Node>& nodes, int levels_left, int moves) const;

  PlannerSettings settings_;
  PlannedMap map_;
  std::vector<PredictedMeasurement> measurements_;
  std::vector<double> scores_;
  int evaluations_ = 0;
};

}  // namespace incognita
