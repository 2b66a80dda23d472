// The next action of a body by a plan over several actions: of a free camera with its gaze, or of the vehicle that carries it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/approach.hpp"
#include "incognita/decision/body_choice.hpp"
#include "incognita/decision/carrier_choice.hpp"
#include "incognita/decision/plan/planner.hpp"

namespace incognita {

/// What both have in common: when a plan is due, and what it is chosen from.
class PlanAtPeriods {
 public:
  PlanAtPeriods(const DecisionSettings& settings, const Mobility& mobility, double sigma_acceleration_m_s2,
                double sigma_angular_acceleration_rad_s2);

  /// Whether an action was chosen in this tick.
  bool choose(const BlockVector& state, const ActionPaths& actions, const Body& body,
              const Expectation& expectation, const Surroundings& surroundings, const Tick& tick);
  void forget();
  void state(StateArchive& archive);
  /// Throws DamagedState if what was restored is of another number of actions.
  void check_actions(std::size_t count) const;

  int chosen() const { return chosen_; }
  double end_t() const { return end_t_; }
  const std::vector<double>& scores() const { return scores_; }

 private:
  void prepare(const Planner::Input& now, const Tick& tick);

  DecisionSettings settings_;
  Growth growth_;
  Planner planner_;
  Approach approach_;
  std::vector<double> scores_;
  int chosen_ = -1;
  double end_t_ = 0;
  std::optional<Eigen::Vector3d> to_;  ///< where the chosen action is to end, if it is sure to arrive
};

/// Of a free camera. The gaze is held at the chosen rates until the next decision.
class PlannedCameraChoice final : public BodyChoice {
 public:
  PlannedCameraChoice(const DecisionSettings& settings, const Mobility& mobility,
                      double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2);
  void choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
              const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) override;
  void forget() override;
  void state(StateArchive& archive) override;
  const std::vector<std::string>& names() const override { return names_; }

 private:
  void look(const BlockVector& camera, double dt);

  JointActions actions_;
  std::vector<std::string> names_;
  PlanAtPeriods plan_;
  bool looking_ = false;
  double heading_rad_ = 0, elevation_rad_ = 0;
  Eigen::Vector2d rates_rad_s_{0, 0};  ///< of both
};

/// Of the vehicle that carries the camera.
class PlannedCarrierChoice final : public BodyChoice {
 public:
  PlannedCarrierChoice(const DecisionSettings& settings, const CarrierSettings& carrier,
                       const Mobility& mobility, double sigma_acceleration_m_s2,
                       double sigma_angular_acceleration_rad_s2);
  void choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
              const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) override;
  void forget() override;
  void state(StateArchive& archive) override;
  const std::vector<std::string>& names() const override { return names_; }

 private:
  SpeedChanges changes_;
  DriveActions actions_;
  std::vector<std::string> names_;
  PlanAtPeriods plan_;
  Eigen::Vector2d drive_{0, 0};
};

}  // namespace incognita
