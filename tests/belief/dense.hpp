// Dense textbook formulas: the reference of the tests of the belief.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/math/random.hpp"

namespace incognita::testing {

Eigen::MatrixXd random_matrix(RandomStream& random, int rows, int columns);
/// Positive definite, with eigenvalues from about 0.1.
Eigen::MatrixXd random_covariance(RandomStream& random, int size);

/// Vehicles and landmarks of these sizes on linear charts, all correlated.
struct Map {
  Belief belief{1};
  std::vector<BlockId> vehicles, landmarks;
  Map(RandomStream& random, const std::vector<int>& vehicle_sizes, const std::vector<int>& landmark_sizes);
};

/// One measurement with the given number of rows and the given blocks.
LinearizedMeasurement random_measurement(RandomStream& random, const Belief& belief, int rows,
                                         const std::vector<BlockId>& blocks);

/// All measurements stacked: H, R and residual over the whole state.
struct Stacked {
  Eigen::MatrixXd H, R;
  Eigen::VectorXd residual;
  Stacked(const Belief& belief, std::span<const LinearizedMeasurement> measurements);
};

struct Posterior {
  Eigen::MatrixXd P, S;
  Eigen::VectorXd delta;
};
/// (A.2.5), (A.2.6) as printed: K = P H' S^-1, P - K S K', K * residual.
Posterior textbook_update(const Eigen::MatrixXd& P, const Stacked& measurements);

/// Means of all blocks on linear charts, in the order of their offsets.
Eigen::VectorXd stacked_mean(const Belief& belief, const std::vector<BlockId>& ids);

/// |a - b| <= tolerance * scale for each element, where the scale is the product of the standard deviations
/// of its row and its column in `prior`: a large block does not mask an error in a small one.
::testing::AssertionResult close_covariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                            const Eigen::MatrixXd& prior, double tolerance);
::testing::AssertionResult close(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance);
::testing::AssertionResult positive_definite(const Eigen::MatrixXd& P);

/// Bytes of everything observable of a belief.
struct Photograph {
  Eigen::MatrixXd P;
  std::vector<double> means;
  Photograph(const Belief& belief, const std::vector<BlockId>& ids);
  bool operator==(const Photograph& other) const { return P == other.P && means == other.means; }
};

}  // namespace incognita::testing
