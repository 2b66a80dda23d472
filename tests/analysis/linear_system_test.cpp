// The monobot of thesis Examples 3.1 and 3.3: observability, controllability and the steady state of its
// filter.
#include "incognita/analysis/observability/linear_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;

/// One landmark (3.7), and optionally an anchor at the origin (3.12).
LinearSystem monobot(double sigma_v, double sigma_w, bool anchored) {
  LinearSystem s;
  s.F = Matrix2d::Identity();
  s.G = Vector2d(1, 0);
  s.Q = MatrixXd::Constant(1, 1, sigma_v * sigma_v);
  s.H = anchored ? MatrixXd((Matrix2d() << -1, 0, -1, 1).finished())
                 : MatrixXd((Eigen::RowVector2d() << -1, 1).finished());
  s.R = sigma_w * sigma_w * MatrixXd::Identity(s.H.rows(), s.H.rows());
  return s;
}

TEST(Monobot, CommonErrorPersistsForAnyGain) {
  RandomStream random(1, "gains");
  const LinearSystem s = monobot(0.3, 0.2, false);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d K(random.uniform(-5, 5), i % 3 == 0 ? -1 : random.uniform(-5, 5));
    EXPECT_LE((error_dynamics(s, K) * Vector2d::Ones() - Vector2d::Ones()).norm(), 1e-12);
    // The other eigenvalue is 1 + k1 - k2: the trace minus one
    EXPECT_NEAR(error_dynamics(s, K).trace() - 1, 1 + K[0] - K[1], 1e-12);
  }
}

TEST(Monobot, RanksOfObservabilityAndControllability) {
  for (const bool anchored : {false, true}) {
    const LinearSystem s = monobot(0.3, 0.2, anchored);
    EXPECT_EQ(rank_of(observability_matrix(s)).rank, anchored ? 2 : 1);
    EXPECT_EQ(rank_of(controllability_matrix(s)).rank, 1) << "no noise reaches the landmark";
  }
  LinearSystem noisy_landmark = monobot(0.3, 0.2, true);
  noisy_landmark.G = Matrix2d::Identity();
  noisy_landmark.Q = 0.01 * Matrix2d::Identity();
  EXPECT_EQ(rank_of(controllability_matrix(noisy_landmark)).rank, 2);
}

/// (3.9)-(3.11) are the covariance and gain after one update and one prediction from diag(0, 1).
TEST(Monobot, PrintedSteadyStateIsTheSecondStep) {
  for (const double v : {0.1, 0.7, 2.0})
    for (const double w : {0.05, 0.5, 1.5}) {
      const LinearSystem s = monobot(v, w, false);
      const Matrix2d P0 = Vector2d(0, 1).asDiagonal();
      const MatrixXd P = predicted(s, updated(s, P0, kalman_gain(s, P0)));
      const Matrix2d printed = Vector2d(v * v, w * w / (1 + w * w)).asDiagonal();
      EXPECT_LE((P - printed).norm(), 1e-14);
      const double s2 = v * v + w * w + w * w / (1 + w * w);  // (3.10)
      const MatrixXd A = error_dynamics(s, kalman_gain(s, P));
      EXPECT_NEAR(A.trace() - 1, w * w / s2, 1e-12);
      EXPECT_GT(std::abs((A.trace() - 1) - (v * v - w * w) / s2), 1e-3) << "as printed below (3.11)";
    }
}

TEST(Monobot, ConvergesToTheClosedForm) {
  for (const double v : {0.1, 0.7, 2.0})
    for (const double w : {0.05, 0.5, 1.5}) {
      const LinearSystem s = monobot(v, w, false);
      const RiccatiLimit limit = iterate_riccati(s, Vector2d(0, 1).asDiagonal().toDenseMatrix());
      ASSERT_TRUE(limit.settled) << limit.reason;
      const double p = (v * v + std::sqrt(std::pow(v, 4) + 4 * v * v * w * w)) / 2;
      const double relative = (s.H * limit.P * s.H.transpose())(0, 0);
      EXPECT_NEAR(relative / p, 1, 1e-9);
      EXPECT_NEAR(limit.K(1, 0), 0, 1e-9) << "the landmark gets no further corrections";
      EXPECT_NEAR(error_dynamics(s, limit.K).trace() - 1, w * w / (p + w * w), 1e-9);
    }
}

TEST(Monobot, LandmarkVarianceFallsAsOneOverTimeWithAnAnchor) {
  const LinearSystem s = monobot(0.3, 0.2, true);
  const auto slowest = [&](int steps) {
    const RiccatiLimit limit = iterate_riccati(s, Matrix2d::Identity(), {.max_iterations = steps});
    EXPECT_FALSE(limit.settled);
    EXPECT_NE(limit.reason.find("steps, the limit"), std::string::npos);
    const auto eigenvalues = MatrixXd(error_dynamics(s, limit.K)).eigenvalues();
    return eigenvalues.cwiseAbs().maxCoeff();
  };
  const double after_100 = slowest(100), after_1000 = slowest(1000);
  EXPECT_LT(after_1000, 1);
  EXPECT_NEAR((1 - after_100) / (1 - after_1000), 10, 0.3);
}

TEST(LinearSystem, RefusalNamesTheWrongSize) {
  LinearSystem s = monobot(1, 1, false);
  s.H = MatrixXd::Ones(1, 3);
  try {
    observability_matrix(s);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "H is 1x3, not 1x2");
  }
}

TEST(Rank, ReportsTheDecidingSingularValues) {
  const Rank rank = rank_of(Eigen::Vector3d(4, 1, 1e-13).asDiagonal().toDenseMatrix());
  EXPECT_EQ(rank.rank, 2);
  EXPECT_NEAR(rank.gap / 1e13, 1, 1e-6);
  EXPECT_EQ(rank_of(MatrixXd::Zero(2, 2)).rank, 0);
  EXPECT_EQ(rank_of(MatrixXd(0, 0)).rank, 0);
}

}  // namespace
}  // namespace incognita
