// Goes to where the nearest unseen cells come into view: the frontiers of Yamauchi (1997), of the exploration volume.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/action_rule.hpp"
#include "incognita/decision/approach.hpp"

namespace incognita {

/// Uses which cells of the exploration volume were in view, the estimated pose and what Approach knows of obstacles. A frontier
/// is an unseen cell beside a seen one; the nearest is the one that is in view soonest, moving and turning at the largest
/// rates. It is pursued until it is seen, or given up if that takes too long, until no other is left. When all are seen the
/// body stays.
class Frontier final : public ActionRule {
 public:
  /// Throws std::invalid_argument for a body whose state is not that of a camera.
  Frontier(const DecisionSettings& settings, const Mobility& mobility);

  int choose(const RuleInput& now, const std::vector<bool>& allowed) override;
  /// Towards the cell that is pursued.
  std::optional<GazeDirection> gaze(const RuleInput& now) override;
  void forget() override { approach_.forget(); }
  void state(StateArchive& archive) override;

  struct Pursuit {
    int cell = 0;
    Eigen::Vector3d viewpoint{0, 0, 0};  ///< from where the body has the cell in view when it faces it
    double until_t = 0;                  ///< s; then it is given up
  };

 private:
  bool drop_done(const RuleInput& now);
  void select(const RuleInput& now);
  std::vector<int> candidates(const RuleInput& now);
  void correct_viewpoint(const RuleInput& now);
  bool is_in_vain(const RuleInput& now) const;
  void select_among(const RuleInput& now, const std::vector<int>& cells, double share);
  std::optional<Eigen::Vector3d> viewpoint_of(const RuleInput& now, const std::vector<Eigen::Vector3d>& patch,
                                              double share, double most_m) const;
  bool would_see_share(const RuleInput& now, const Eigen::Vector3d& from,
                       const std::vector<Eigen::Vector3d>& patch, double share) const;
  GazeDirection direction_to(const Eigen::Vector3d& from, const Eigen::Vector3d& cell) const;
  bool would_see(const RuleInput& now, const Eigen::Vector3d& from, const GazeDirection& gaze,
                 const Eigen::Vector3d& cell) const;
  double turn_to_view_rad(const RuleInput& now, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& cell) const;
  Approach::Cost cost_of(const RuleInput& now) const;

  WorldBounds bounds_;
  double period_s_, max_elevation_rad_;
  Approach approach_;
  std::optional<Pursuit> pursuit_;
  std::vector<int> given_up_;           ///< cells
  std::optional<GazeDirection> faces_;  ///< last wanted gaze
};

/// Centers of the unseen cells about a cell, its own first, m.
std::vector<Eigen::Vector3d> unseen_about(const ExplorationVolume& volume, int cell);

/// The unseen cells that have a seen one beside them; all unseen ones if none has.
std::vector<int> frontier_cells(const ExplorationVolume& volume);

}  // namespace incognita
