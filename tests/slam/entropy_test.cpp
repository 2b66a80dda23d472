#include "incognita/slam/mapper/estimate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

/// From the eigenvalues of a dense covariance: no factorisation shared with what is tested.
double dense_entropy(const Eigen::MatrixXd& P) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(P, Eigen::EigenvaluesOnly);
  return 0.5 * (P.rows() * std::log(2 * M_PI * M_E) + eigen.eigenvalues().array().log().sum());
}

Eigen::MatrixXd random_matrix(int rows, int cols, RandomStream& random) {
  Eigen::MatrixXd A(rows, cols);
  for (int i = 0; i < A.size(); ++i) A(i) = random.normal();
  return A;
}

Estimate camera_and_points(int points) {
  RandomStream random(1, "entropy");
  Estimate estimate;
  FreeCameraMotion::State<double> x = FreeCameraMotion::State<double>::Zero();
  x[3] = 1;
  const Eigen::MatrixXd A = random_matrix(12, 12, random);
  const BlockId camera = estimate.bodies.emplace_back().block = estimate.belief.add_vehicle(
      FreeCameraMotion::chart, x, 0.01 * (A * A.transpose() + Eigen::MatrixXd::Identity(12, 12)));
  for (int i = 0; i < points; ++i) {
    const Belief::Parent parent{camera, BlockMatrix(random_matrix(3, 12, random))};
    estimate.belief.augment(Chart::line(3), Eigen::Vector3d(i, 1, 2), {&parent, 1},
                            0.02 * (i + 1) * Eigen::Matrix3d::Identity());
  }
  return estimate;
}

TEST(Entropies, AreThoseOfTheDenseCovariance) {
  const Estimate estimate = camera_and_points(9);
  const Eigen::MatrixXd P = estimate.belief.dense_covariance();
  ASSERT_EQ(P.rows(), 12 + 9 * 3);
  const Entropy entropy = entropies(estimate);
  EXPECT_NEAR(entropy.vehicle, dense_entropy(P.topLeftCorner(12, 12)), 1e-8);
  EXPECT_NEAR(entropy.map, dense_entropy(P.bottomRightCorner(27, 27)), 1e-8);
  EXPECT_NEAR(entropy.total, dense_entropy(P), 1e-8);
  EXPECT_NEAR(vehicle_entropy(estimate), entropy.vehicle, 1e-9);
  EXPECT_LT(entropy.total, entropy.vehicle + entropy.map) << "what they share is counted once";
}

TEST(Entropies, WithoutAMapAllIsTheCamera) {
  const Entropy entropy = entropies(camera_and_points(0));
  EXPECT_EQ(entropy.map, 0);
  EXPECT_NEAR(entropy.total, entropy.vehicle, 1e-12);
}

}  // namespace
}  // namespace incognita
