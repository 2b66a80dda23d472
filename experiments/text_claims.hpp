// Claims that the running text makes outside the examples: parts of the entry `text-1-3`.
#pragma once

#include <vector>

#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {

/// Chapter 2: what SLAM is said to do, the Riccati equation (2.18), new landmarks (2.20)-(2.26).
std::vector<Claim> chapter_2_claims(int seeds);

/// Chapter 3 outside its examples, and what Chapter 1 says of it.
std::vector<Claim> chapter_3_claims(int seeds);

/// Covariance after so many rounds of prediction and update.
inline Eigen::MatrixXd filtered(const LinearSystem& system, Eigen::MatrixXd P, int steps) {
  for (int k = 0; k < steps; ++k) {
    P = predicted(system, P);
    P = updated(system, P, kalman_gain(system, P));
  }
  return P;
}

}  // namespace incognita
