// Covariances of a Kalman filter over many steps, for linear systems and for the monobot.
#pragma once

#include <Eigen/Eigenvalues>

#include "experiments/monobot.hpp"
#include "incognita/analysis/observability/linear_system.hpp"

namespace incognita {

inline constexpr double rounding_error = 1e-12;

/// What goes to zero: 100 times the steps leave less than a tenth of it.
inline bool vanishes(double after_some_steps, double after_100_times_as_many) {
  return after_100_times_as_many < 0.1 * after_some_steps;
}

/// Covariance after `steps` predictions and updates.
inline Eigen::MatrixXd filtered(const LinearSystem& system, Eigen::MatrixXd P, int steps) {
  for (int k = 0; k < steps; ++k) {
    P = predicted(system, P);
    P = updated(system, P, kalman_gain(system, P));
  }
  return P;
}

inline Eigen::MatrixXd start_of(const monobot::Setup& setup) { return monobot::first_covariance(setup); }

/// The monobot's covariance after the given number of steps.
inline Eigen::MatrixXd after(const monobot::Setup& setup, int steps) {
  return filtered(monobot::system(setup), start_of(setup), steps);
}

/// Covariance of noises of 0.05 m a step on the landmarks, and on the robot too if asked.
inline Eigen::MatrixXd constant_noise(const monobot::Setup& setup, bool robot_too) {
  const int n = monobot::states(setup);
  Eigen::MatrixXd dP = 0.05 * 0.05 * Eigen::MatrixXd::Identity(n, n);
  if (!robot_too) dP(0, 0) = 0;
  return dP;
}

/// The monobot with these noises.
inline LinearSystem with_constant_noise(const monobot::Setup& setup, bool robot_too) {
  return monobot::with_pseudo_noise(monobot::system(setup), constant_noise(setup, robot_too));
}
inline LinearSystem with_noisy_landmarks(const monobot::Setup& setup) {
  return with_constant_noise(setup, false);
}

/// Absolute values.
inline Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& M) { return M.eigenvalues().cwiseAbs(); }

inline double relative_difference(const Eigen::MatrixXd& A, const Eigen::MatrixXd& truth) {
  return (A - truth).norm() / truth.norm();
}

inline double smallest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace incognita
