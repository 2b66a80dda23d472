// A plan of motion and gaze over several actions ahead: receding horizon, beam search.
//
// The score of a plan is its information gain about landmarks and pose, to the resolution that the task needs: what is finer
// does not count. Measurements are expected along the way, not only at its end, each given the ones before (imagined_map.hpp);
// what is left to map counts by the time to get there (cost_to_go.hpp). A plan on which too few landmarks would be matched
// somewhere is a risk to lose track, and is chosen only if there is no other.
//
// The first actions of a comparison can be imagined a few at a time, in the ticks before it is due, from where the action under
// way is expected to end.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/decision/expectation.hpp"
#include "incognita/decision/plan/action_paths.hpp"
#include "incognita/decision/plan/cost_to_go.hpp"
#include "incognita/decision/plan/imagined_map.hpp"

namespace incognita {

struct PlannerSettings {
  /// Periods for which the actions of each level are held: the first is executed, the later ones are coarser.
  std::vector<int> held_periods{1};
  int views_per_period = 2;
  double period_s = 1;
  int max_evaluations = 300;  ///< actions imagined in one comparison; at least one per first action
  int max_landmarks = 48;     ///< of the map, that a plan follows
  int max_others = 16;        ///< of the rest of the map, which stand for all of it
  int max_measured = 12;      ///< of the map, that a view corrects the imagined estimate by
  int min_matches = 8;        ///< of the map in every view; 0: no constraint
  double pose_weight = 1;
  double discount_s = 10;  ///< of what is left to map; 0: it is worth nothing
  Reach reach = {};
  Resolution resolution = {};
};

/// What plans are compared by: the first difference decides, less of it is better.
struct PlanWorth {
  double outside_m = 0;
  bool blocked = false;
  int missing_matches = 0;  ///< summed over its views
  double score = 0;         ///< nats; more is better
};
bool is_better(const PlanWorth& a, const PlanWorth& b);

class Planner {
 public:
  explicit Planner(PlannerSettings settings) : settings_(std::move(settings)) {}

  struct Input {
    const Estimate& estimate;
    std::size_t body;
    const BlockVector& state;  ///< of the body, as the actions take it
    const ActionPaths& actions;
    const Growth& growth;  ///< over the time between two views
    const Expectation& expectation;
    std::span<const ExpectedLandmark> unmapped;              ///< as the expectation predicts them
    double expected_var_m2;                                  ///< of each of their coordinates
    std::function<bool(const BlockVector& state)> is_clear;  ///< of obstacles that are known
  };

  /// An action under way, and the time that is left of it.
  struct UnderWay {
    int action = 0;
    double left_s = 0;
    /// Where it is to end, world, m; none: as far from the present state as the action leads in that time.
    std::optional<Eigen::Vector3d> to = std::nullopt;
  };

  /// Begins a comparison of plans that start where the action under way ends, or, without one, in the present state.
  void begin(const Input& now, const std::optional<UnderWay>& under_way);
  bool has_begun() const { return root_.has_value(); }
  /// Imagines the next `count` first actions.
  void imagine(const Input& now, int count);
  /// Imagines what is left, goes deeper, and ends the comparison: the first action of the best plan.
  int choose(const Input& now);
  void forget() { root_.reset(); }

  /// Nats by first action: of the best plan that begins with it, or of the action alone where no plan went on from it.
  const std::vector<double>& scores() const { return scores_; }
  int evaluations() const { return evaluations_; }

  /// Saves or restores a comparison that has begun: math/saved_state/.
  void state(StateArchive& archive);

 private:
  struct Node {
    int first = 0;
    BlockVector state;
    ImaginedMap map;
    double t_s = 0;  ///< since the plan began
    PlanWorth worth = {};
  };
  bool goes_deeper() const { return settings_.held_periods.size() > 1; }
  void take_landmarks(const Input& now, const BlockVector& start);
  void view(const Input& now, const BlockVector& before, Node& node);
  void rate(Node& node) const;
  Node after(const Input& now, const Node& from, int action, int periods);
  void keep_best(std::vector<Node>& nodes, int levels_left, int actions) const;
  int choose_deeper(const Input& now);

  PlannerSettings settings_;
  PlannedMap map_;
  std::vector<ExpectedLandmark> unmapped_;  ///< when the comparison began: all actions are rated by the same
  std::optional<Node> root_;                ///< while plans are compared
  std::vector<PlanWorth> worths_;           ///< of the first actions imagined so far
  std::vector<Node> level_;                 ///< the same, where plans go deeper
  double entropy_before_ = 0;               ///< of the pose, at the root
  std::vector<PredictedMeasurement> measurements_;
  std::vector<double> scores_;
  int evaluations_ = 0;
};

}  // namespace incognita
