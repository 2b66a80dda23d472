// LQG regulation to a goal: thesis (5.2), (5.3) and (5.6). The estimate comes from any filter; by the
// separation principle its covariance does not enter the gain.
//
//     u = u* - L (x_hat - x*)
//
// u* holds the goal, x* = F x* + G u*; it is 0 if F x* = x*. L is recomputed from the current Jacobians, as
// in Example 5.1; it is not guaranteed to be optimal for the nonlinear system.
//
// For a planar vehicle only the position is regulated: with F = I and G = Q_r dt, the position rows at rest
// with a control point off the axle, every position can be reached and held. With the heading as a third
// state the linearization at rest has three modes at 1 and two inputs, and no gain moves all three. Stability
// of the sampled loop does not cover a body that turns far during one command: keep the turn rate limit times
// the period well below 1 rad (see held_command.hpp).
#pragma once

#include <Eigen/Core>

#include "incognita/control/lqr.hpp"
#include "incognita/control/planar_command.hpp"
#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

/// Weights of (5.1): Q1 n x n on the states, Q2 m x m on the inputs.
struct RegulatorWeights {
  Eigen::MatrixXd Q1;
  Eigen::MatrixXd Q2;
};

struct Regulation {
  Eigen::VectorXd u;       ///< 0 unless the outcome is `converged`
  bool saturated = false;  ///< whether an input is clamped
  SteadyGain gain;         ///< states the reason if there is none
};

/// One step of the regulator for a linear or linearized system. `largest` (m) holds the largest magnitude of
/// each input. Throws std::invalid_argument for wrong sizes, and for a goal that no constant input holds.
Regulation regulate(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G, const Eigen::VectorXd& x_hat,
                    const Eigen::VectorXd& goal, const RegulatorWeights& weights,
                    const Eigen::VectorXd& largest);

/// The refusal of weights that have no gain, for that reason.
UnfitSetting without_gain(const std::string& reason);

struct PlanarRegulatorSettings {
  DifferentialDrive body{0.3, 0};                    ///< its control point; forward_m must not be 0
  Eigen::Matrix2d Q1 = Eigen::Matrix2d::Identity();  ///< position, world, 1/m^2
  Eigen::Matrix2d Q2 = Eigen::Matrix2d::Identity();  ///< speed, s^2/m^2, and turn rate, s^2/rad^2
  double period_s = 0.1;                             ///< duration of one command
  PlanarLimits limits{};
};

struct PlanarRegulation {
  PlanarCommand command;
  Eigen::Matrix2d L = Eigen::Matrix2d::Zero();  ///< gain of (5.6): speed and turn rate by position
};

class PlanarRegulator {
 public:
  /// Throws std::invalid_argument if these settings admit no regulator, UnfitSetting if the weights have no gain; the
  /// message states the reason.
  explicit PlanarRegulator(const PlanarRegulatorSettings& settings);

  /// (5.6) with the Jacobians at the estimate. A saturated command keeps its direction.
  PlanarRegulation act(const planar::Pose<double>& estimate, const Eigen::Vector2d& goal) const;

 private:
  Eigen::Matrix2d gain_at(double heading) const;

  PlanarRegulatorSettings settings_;
};

/// F - G [L 0] for position and heading with the plant's Jacobians under that input; its eigenvalues are
/// shown in Figure 5.5. At rest one of them is 1, that of the heading.
Eigen::Matrix3d planar_closed_loop(const DifferentialDrive& body, const planar::Pose<double>& pose,
                                   const Eigen::Vector2d& input, double period_s, const Eigen::Matrix2d& L);

}  // namespace incognita
