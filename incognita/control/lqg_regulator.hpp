// LQG regulation to a goal: thesis (5.2), (5.3) and (5.6). The estimate is any filter's; by separation its
// covariance does not enter the gain.
//
//   u = u* - L (x_hat - x*)
//
// u* holds the goal, x* = F x* + G u*; it is 0 where F x* = x*. L is computed anew from the Jacobians of the
// present, as in Example 5.1: with these there is no guarantee that it is the optimum for the nonlinear
// system.
//
// Of a planar vehicle only the position is regulated: with F = I and G = Q_r dt, the rows of the position at
// rest, whose control point lies off the axle, every position can be reached and held. With the heading as a
// third state the linearisation at rest has three modes at 1 and two inputs, and no gain moves all three.
// That the sampled loop is stable says nothing of a body that turns far while a command is held: keep the
// turn rate limit times the period well below 1 rad (held_command.hpp says why).
#pragma once

#include <Eigen/Core>

#include "incognita/control/lqr.hpp"
#include "incognita/control/planar_command.hpp"
#include "incognita/models/planar_vehicle.hpp"

namespace incognita {

/// Of (5.1): Q1 n x n per state, Q2 m x m per input.
struct RegulatorWeights {
  Eigen::MatrixXd Q1;
  Eigen::MatrixXd Q2;
};

struct Regulation {
  Eigen::VectorXd u;       ///< 0 unless the outcome is `converged`
  bool saturated = false;  ///< an input is cut off at its limit
  SteadyGain gain;         ///< with the reason when there is none
};

/// One step of the regulator for a linear, or presently so linearised, system. `largest` (m) holds the
/// largest magnitude of each input. Throws std::invalid_argument for wrong sizes, and for a goal that no
/// constant input holds.
Regulation regulate(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G, const Eigen::VectorXd& x_hat,
                    const Eigen::VectorXd& goal, const RegulatorWeights& weights,
                    const Eigen::VectorXd& largest);

struct PlanarRegulatorSettings {
  DifferentialDrive body{0.3, 0};                    ///< where the control point is; forward_m is not 0
  Eigen::Matrix2d Q1 = Eigen::Matrix2d::Identity();  ///< position, world, 1/m^2
  Eigen::Matrix2d Q2 = Eigen::Matrix2d::Identity();  ///< speed, s^2/m^2, and turn rate, s^2/rad^2
  double period_s = 0.1;                             ///< how long a command is held
  PlanarLimits limits{};
};

struct PlanarRegulation {
  PlanarCommand command;
  Eigen::Matrix2d L = Eigen::Matrix2d::Zero();  ///< of (5.6): speed and turn rate by position
};

class PlanarRegulator {
 public:
  /// Throws std::invalid_argument with the reason when there is no regulator with these settings.
  explicit PlanarRegulator(const PlanarRegulatorSettings& settings);

  /// (5.6) with the Jacobians at the estimate. A saturated command keeps its direction.
  PlanarRegulation act(const planar::Pose<double>& estimate, const Eigen::Vector2d& goal) const;

 private:
  Eigen::Matrix2d gain_at(double heading) const;

  PlanarRegulatorSettings settings_;
};

/// F - G [L 0] of position and heading with the plant's Jacobians under that input: what Figure 5.5 shows the
/// eigenvalues of. At rest one of them is 1, the heading's.
Eigen::Matrix3d planar_closed_loop(const DifferentialDrive& body, const planar::Pose<double>& pose,
                                   const Eigen::Vector2d& input, double period_s, const Eigen::Matrix2d& L);

}  // namespace incognita
