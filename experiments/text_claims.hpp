// Claims that the running text makes outside the examples: parts of the entry `text-1-3`.
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "experiments/monobot.hpp"
#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {

/// Chapter 2: properties of SLAM, the Riccati equation (2.18), new landmarks (2.20)-(2.26).
std::vector<Claim> chapter_2_claims(int seeds);

/// Chapter 3 outside its examples, and Chapter 1 about it.
std::vector<Claim> chapter_3_stability_claims();
std::vector<Claim> chapter_3_landmark_claims(int seeds);

inline constexpr double rounding_error = 1e-12;

/// Covariance after so many rounds of prediction and update.
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

/// The monobot with noise of 0.05 m a step on the landmarks.
inline LinearSystem with_noisy_landmarks(const monobot::Setup& setup) {
  const int n = monobot::states(setup);
  Eigen::MatrixXd dP = 0.05 * 0.05 * Eigen::MatrixXd::Identity(n, n);
  dP(0, 0) = 0;
  return monobot::with_pseudo_noise(monobot::system(setup), dP);
}

/// Absolute values.
inline Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& M) { return M.eigenvalues().cwiseAbs(); }

}  // namespace incognita
