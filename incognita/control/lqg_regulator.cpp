#include "incognita/control/lqg_regulator.hpp"

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "incognita/control/feedback_linearization.hpp"
#include "incognita/math/expect_size.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Smallest u* with x* = F x* + G u*.
VectorXd holding_input(const MatrixXd& F, const MatrixXd& G, const VectorXd& goal) {
  const VectorXd drift = goal - F * goal;
  VectorXd u = G.completeOrthogonalDecomposition().solve(drift);
  const double size = goal.norm() + (F * goal).norm();
  if ((G * u - drift).norm() <= 1e-9 * size) return u;
  throw std::invalid_argument("no constant input holds the goal: the system moves away from it");
}

}  // namespace

Regulation regulate(const MatrixXd& F, const MatrixXd& G, const VectorXd& x_hat, const VectorXd& goal,
                    const RegulatorWeights& weights, const VectorXd& largest) {
  Regulation answer;
  answer.gain = steady_gain(F, G, weights.Q1, weights.Q2);  // also checks the sizes
  expect_size("x_hat", x_hat, F.rows(), 1);
  expect_size("the goal", goal, F.rows(), 1);
  expect_size("the largest inputs", largest, G.cols(), 1);
  if (!(largest.array() > 0).all()) throw std::invalid_argument("the largest inputs must be positive");
  answer.u = VectorXd::Zero(G.cols());
  if (answer.gain.outcome != RegulatorOutcome::converged) return answer;
  const VectorXd desired = holding_input(F, G, goal) - answer.gain.L * (x_hat - goal);
  if (!desired.allFinite()) throw std::invalid_argument("the estimate or the goal is not finite");
  answer.u = desired.cwiseMax(-largest).cwiseMin(largest);
  answer.saturated = answer.u != desired;
  return answer;
}

UnfitSetting without_gain(const std::string& reason) {
  return {{"controller.weight_state", "controller.weight_input", "run.rate_hz"}, reason};
}

PlanarRegulator::PlanarRegulator(const PlanarRegulatorSettings& settings) : settings_(settings) {
  settings_.limits.check();
  if (!(settings_.period_s > 0) || !std::isfinite(settings_.period_s))
    throw std::invalid_argument("the period must be positive and finite");
  gain_at(0);  // throws if there is none; other headings only rotate it
}

Eigen::Matrix2d PlanarRegulator::gain_at(double heading) const {
  const Eigen::Matrix2d G = point_velocity_by_input(settings_.body, heading) * settings_.period_s;
  const SteadyGain gain = steady_gain(Eigen::Matrix2d::Identity(), G, settings_.Q1, settings_.Q2);
  if (gain.outcome != RegulatorOutcome::converged) throw without_gain(gain.reason);
  return gain.L;
}

PlanarRegulation PlanarRegulator::act(const planar::Pose<double>& estimate,
                                      const Eigen::Vector2d& goal) const {
  if (!estimate.allFinite() || !goal.allFinite())
    throw std::invalid_argument("the estimate or the goal is not finite");
  const Eigen::Matrix2d L = gain_at(estimate[2]);
  return {limited(-L * (estimate.head<2>() - goal), settings_.limits), L};
}

Eigen::Matrix3d planar_closed_loop(const DifferentialDrive& body, const planar::Pose<double>& pose,
                                   const Eigen::Vector2d& input, double period_s, const Eigen::Matrix2d& L) {
  const planar::Step step = body.step(pose, input, period_s);
  Eigen::Matrix3d A = step.F;
  A.leftCols<2>() -= step.G * L;
  return A;
}

}  // namespace incognita
