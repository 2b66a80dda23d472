// Choice of the action that brings a body nearest to where it is to go, around what stops it.
//
// What it knows of obstacles: readings of ranges, where the body has such a sensor; else only that it did not arrive where an
// action was to end.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "incognita/decision/action_rule.hpp"

namespace incognita {

class Approach {
 public:
  /// Cost of being in a state, s.
  using Cost = std::function<double(const BlockVector& state)>;

  /// A straight way, m.
  struct Leg {
    Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  };

  explicit Approach(const Mobility& mobility) : mobility_(mobility) {}

  /// To be called once per decision, before the others.
  void update(const RuleInput& now) { update(now.state, now.surroundings); }
  void update(const BlockVector& state, const Surroundings& surroundings);

  /// The first of the next few actions with the least cost on their way; of several that are equal, "stay", then the first. One
  /// action alone hardly changes the direction of a vehicle, and leads no camera around what stopped it.
  int choose(const RuleInput& now, const std::vector<bool>& allowed, const Cost& cost_s);

  /// Whether nothing is known that would stop the body there.
  bool is_clear(const Eigen::Vector3d& position) const;
  /// The point nearest to `to`, on the level way from there to `center`, that is clear; `to` if none is.
  Eigen::Vector3d clear_point(const Eigen::Vector3d& to, const Eigen::Vector3d& center) const;

  /// Time to get to a point at the largest speed, s; of a body that drives with the time to turn to it.
  double time_to_s(const BlockVector& state, const Eigen::Vector3d& to) const;

  const Mobility& mobility() const { return mobility_; }
  /// The action that was chosen, by another than choose().
  void go(const Leg& leg) {
    if (mobility_.arrives) under_way_ = leg;
  }
  /// The action under way no longer counts.
  void forget() { under_way_.reset(); }
  void state(StateArchive& archive);

 private:
  void note_stop(const Eigen::Vector3d& position);
  void read_obstacles(const BlockVector& state, const Surroundings& surroundings);
  bool was_stopped_at(const Eigen::Vector3d& position) const;
  double penalty_s(const ActionOutcome& outcome) const;
  double least_cost_s(const ActionSet& action_set, const BlockVector& state, int actions,
                      const Cost& cost_s) const;

  Mobility mobility_;
  std::vector<Eigen::Vector3d> stops_;      ///< ends of actions that were not reached, the last ones
  std::optional<Leg> under_way_;            ///< the current action, where it is to arrive
  std::vector<Eigen::Vector3d> obstacles_;  ///< by the ranges of this decision
};

/// Distance at which a point counts as reached, m: from anywhere, an action leads nearer than that.
double reach_m(const Mobility& mobility);
/// Distance ahead on a path at which a body aims, m: far enough that an action leads nearer, and that a vehicle can turn there.
double aim_ahead_m(const Mobility& mobility);
/// The direction in which a body with this state of a camera drives, rad.
double driven_heading(const BlockVector& state, const Mobility& mobility);

}  // namespace incognita
