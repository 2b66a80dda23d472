// Regulators (5.1) to (5.4): known solutions, optimality, and every refusal.
#include "incognita/control/lqr.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/math/random.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::message_of;
using enum RegulatorOutcome;

MatrixXd scalar(double value) { return MatrixXd::Constant(1, 1, value); }
MatrixXd identity(int n) { return MatrixXd::Identity(n, n); }

MatrixXd random_matrix(RandomStream& random, Eigen::Index rows, Eigen::Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

MatrixXd random_definite(RandomStream& random, int n) {
  const MatrixXd A = random_matrix(random, n, n);
  return A * A.transpose() + 0.1 * identity(n);
}

/// The algebraic Riccati equation as in textbooks, not in the form of (5.4).
double residual(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1, const MatrixXd& Q2,
                const MatrixXd& T) {
  const MatrixXd FTG = F.transpose() * T * G;
  const MatrixXd right = F.transpose() * T * F + Q1 -
                         FTG * (Q2 + G.transpose() * T * G).fullPivHouseholderQr().solve(FTG.transpose());
  return (T - right).norm() / std::max(T.norm(), (F.transpose() * T * F).norm());
}

/// Sum of x' Q1 x + u' Q2 u over the gains, with T_end on the last state.
double simulated_cost(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1, const MatrixXd& Q2,
                      const MatrixXd& T_end, const std::vector<MatrixXd>& gains, VectorXd x) {
  double cost = 0;
  for (const MatrixXd& L : gains) {
    const VectorXd u = -L * x;
    cost += x.dot(Q1 * x) + u.dot(Q2 * u);
    x = F * x + G * u;
  }
  return cost + x.dot(T_end * x);
}

TEST(SteadyGain, OfAScalarIsTheRootOfAQuadratic) {
  for (const double f : {0.0, 0.5, 1.0, -1.0, 3.0})
    for (const double q2 : {0.01, 1.0, 100.0}) {
      const double g = 0.7, q1 = 2;
      // g^2 T^2 + (q2 (1 - f^2) - q1 g^2) T - q1 q2 = 0
      const double b = q2 * (1 - f * f) - q1 * g * g;
      const double T = (-b + std::sqrt(b * b + 4 * g * g * q1 * q2)) / (2 * g * g);
      const SteadyGain answer = steady_gain(scalar(f), scalar(g), scalar(q1), scalar(q2));
      ASSERT_EQ(answer.outcome, converged) << answer.reason;
      EXPECT_NEAR(answer.T(0, 0) / T, 1, 1e-12);
      EXPECT_NEAR(answer.L(0, 0), g * T * f / (q2 + g * g * T), 1e-12);
    }
}

/// Unit period and costs; reference from 300 steps of the scalar equations in 40-digit arithmetic.
TEST(SteadyGain, OfTheDoubleIntegrator) {
  Matrix2d F;
  F << 1, 1, 0, 1;
  const SteadyGain answer = steady_gain(F, Vector2d(0, 1), identity(2), scalar(1));
  ASSERT_EQ(answer.outcome, converged) << answer.reason;
  Matrix2d T;
  T << 2.947122966707013, 2.369205407092467, 2.369205407092467, 4.613134260996180;
  EXPECT_LE((answer.T - T).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LE((answer.L - Eigen::RowVector2d(0.422082440385454, 1.243928853903714)).norm(), 1e-11);
}

TEST(SteadyGain, StabilizesEveryControllableSystem) {
  RandomStream random(1, "regulators");
  for (int i = 0; i < 300; ++i) {
    const int n = 1 + random.below(6), m = 1 + random.below(3);
    const MatrixXd F = random.uniform(0.2, 2) * random_matrix(random, n, n), G = random_matrix(random, n, m);
    const MatrixXd Q1 = random_definite(random, n), Q2 = random_definite(random, m);
    const SteadyGain answer = steady_gain(F, G, Q1, Q2);
    ASSERT_EQ(answer.outcome, converged) << answer.reason;
    EXPECT_TRUE(is_stabilizing(F, G, answer.L));
    EXPECT_LE(residual(F, G, Q1, Q2, answer.T), 1e-9);
    EXPECT_LE(answer.residual, 1e-9);
    EXPECT_LE(answer.iterations, 30);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(answer.T).eigenvalues()[0], 0);
  }
}

TEST(SteadyGain, ConvergesWhenAMillionStepsAreNecessary) {
  Matrix2d F;
  F << 1, 1e-3, 0, 1;  // a loop at 1 kHz with nearly no cost of position
  const MatrixXd G = Vector2d(0.5e-6, 1e-3), Q1 = Vector2d(1e-8, 0).asDiagonal();
  const SteadyGain answer = steady_gain(F, G, Q1, scalar(1));
  ASSERT_EQ(answer.outcome, converged) << answer.reason;
  EXPECT_GT(is_stabilizing(F, G, answer.L).spectral_radius, 1 - 1e-4);
  EXPECT_LE(residual(F, G, Q1, scalar(1), answer.T), 1e-9);
}

TEST(SteadyGain, IsIndependentOfUnits) {
  RandomStream random(2, "units");
  for (int i = 0; i < 50; ++i) {
    const MatrixXd F = random_matrix(random, 3, 3), G = random_matrix(random, 3, 2);
    const MatrixXd Q1 = random_definite(random, 3), Q2 = random_definite(random, 2);
    const double input = std::pow(10, random.uniform(-9, 9)), money = std::pow(10, random.uniform(-9, 9));
    const SteadyGain one = steady_gain(F, G, Q1, Q2);
    const SteadyGain other = steady_gain(F, G * input, Q1 * money, Q2 * money * input * input);
    ASSERT_EQ(other.outcome, converged) << other.reason;
    EXPECT_TRUE((other.L * input).isApprox(one.L, 1e-8));
    EXPECT_TRUE((other.T / money).isApprox(one.T, 1e-8));
  }
}

TEST(FiniteHorizon, CostIsThePredictedOneAndNoOtherGainIsCheaper) {
  RandomStream random(3, "costs");
  for (int i = 0; i < 100; ++i) {
    const int n = 1 + random.below(4), m = 1 + random.below(2), steps = 1 + random.below(12);
    const MatrixXd F = random_matrix(random, n, n), G = random_matrix(random, n, m);
    const MatrixXd Q1 = random_definite(random, n), Q2 = random_definite(random, m);
    const MatrixXd T_end = random_definite(random, n);
    HorizonGains way = finite_horizon_gains(F, G, Q1, Q2, T_end, steps);
    ASSERT_EQ(way.outcome, converged) << way.reason;
    ASSERT_EQ(way.L.size(), static_cast<std::size_t>(steps));
    const VectorXd x = random_matrix(random, n, 1);
    const double promised = x.dot(way.T0 * x);
    EXPECT_NEAR(simulated_cost(F, G, Q1, Q2, T_end, way.L, x) / promised, 1, 1e-9);
    way.L[static_cast<std::size_t>(random.below(steps))] += 0.1 * random_matrix(random, m, n);
    EXPECT_GE(simulated_cost(F, G, Q1, Q2, T_end, way.L, x), promised * (1 - 1e-12));
  }
}

TEST(FiniteHorizon, ConvergesToTheSteadyGain) {
  RandomStream random(4, "horizon");
  for (int i = 0; i < 30; ++i) {
    const MatrixXd F = random_matrix(random, 3, 3), G = random_matrix(random, 3, 2);
    const SteadyGain steady = steady_gain(F, G, identity(3), identity(2));
    const HorizonGains way = finite_horizon_gains(F, G, identity(3), identity(2), MatrixXd::Zero(3, 3), 2000);
    ASSERT_EQ(steady.outcome, converged) << steady.reason;
    EXPECT_TRUE(way.L.front().isApprox(steady.L, 1e-8));
    EXPECT_TRUE(way.T0.isApprox(steady.T, 1e-8));
    const VectorXd x = random_matrix(random, 3, 1);
    const std::vector<MatrixXd> same(2000, steady.L);
    EXPECT_NEAR(
        simulated_cost(F, G, identity(3), identity(2), MatrixXd::Zero(3, 3), same, x) / x.dot(steady.T * x),
        1, 1e-8);
  }
}

TEST(FiniteHorizon, AcceptsPositiveSemidefiniteCosts) {
  const HorizonGains deadbeat =
      finite_horizon_gains(scalar(2), scalar(1), scalar(1), scalar(0), scalar(1), 3);
  ASSERT_EQ(deadbeat.outcome, converged) << deadbeat.reason;
  EXPECT_DOUBLE_EQ(deadbeat.L[0](0, 0), 2);
  EXPECT_EQ(finite_horizon_gains(scalar(2), scalar(1), scalar(1), scalar(0), scalar(0), 3).outcome,
            cost_not_definite);
  EXPECT_EQ(finite_horizon_gains(scalar(2), scalar(1), scalar(1), scalar(-1), scalar(1), 3).outcome,
            cost_not_definite);
  EXPECT_EQ(finite_horizon_gains(scalar(1e200), scalar(0), scalar(1), scalar(1), scalar(1), 3).outcome,
            not_converged);
  EXPECT_TRUE(finite_horizon_gains(scalar(2), scalar(1), scalar(1), scalar(1), scalar(5), 0).L.empty());
}

/// A system with uncontrollable modes, in rotated coordinates.
struct Rotated {
  MatrixXd F, G;
};

Rotated turned(RandomStream& random, const MatrixXd& F, const MatrixXd& G) {
  const MatrixXd R = random_matrix(random, F.rows(), F.rows()).householderQr().householderQ();
  return {R * F * R.transpose(), R * G};
}

TEST(SteadyGain, NamesTheUncontrollableMode) {
  RandomStream random(5, "modes");
  Matrix2d spiral;
  spiral << 1.2, -0.5, 0.5, 1.2;
  for (int i = 0; i < 50; ++i) {
    MatrixXd F = MatrixXd::Zero(4, 4), G = MatrixXd::Zero(4, 2);
    F.topLeftCorner(2, 2) = random_matrix(random, 2, 2);
    F.topRightCorner(2, 2) = random_matrix(random, 2, 2);
    F.bottomRightCorner(2, 2) = spiral;
    G.topRows(2) = random_matrix(random, 2, 2);
    Rotated s = turned(random, F, G);
    const SteadyGain growing = steady_gain(s.F, s.G, identity(4), identity(2));
    EXPECT_EQ(growing.outcome, not_stabilizable);
    EXPECT_HAS(growing.reason, "of magnitude 1.3");
    F.bottomRightCorner(2, 2) = 0.5 * spiral;  // this mode decays and may be uncontrollable
    s = turned(random, F, G);
    EXPECT_EQ(steady_gain(s.F, s.G, identity(4), identity(2)).outcome, converged);
  }
}

TEST(SteadyGain, CannotMoveALandmark) {  // the monobot (3.7): the second mode stays where it is
  const SteadyGain answer = steady_gain(identity(2), Vector2d(1, 0), identity(2), scalar(1));
  EXPECT_EQ(answer.outcome, not_stabilizable);
  EXPECT_HAS(answer.reason, "the mode 1, of magnitude 1");
  EXPECT_EQ(answer.L.size(), 0);
}

TEST(SteadyGain, RefusesUncontrollableModesThatCoincideWithOthers) {
  RandomStream random(6, "coincide");
  Matrix2d F;
  F << 1, 1, 0, 1;  // one Jordan block, whose lower end is uncontrollable
  for (int i = 0; i < 100; ++i) {
    const Rotated s = turned(random, F, Vector2d(1, 0));
    EXPECT_EQ(steady_gain(s.F, s.G, identity(2), scalar(1)).outcome, not_stabilizable);
  }
}

TEST(SteadyGain, RefusesACostThatDoesNotObserveAMode) {
  const MatrixXd first_only = Vector2d(1, 0).asDiagonal();
  const SteadyGain standing = steady_gain(identity(2), identity(2), first_only, identity(2));
  EXPECT_EQ(standing.outcome, not_detectable);
  EXPECT_HAS(standing.reason, "the mode 1, of magnitude 1");
  Matrix2d F;
  F << 1, 1, 0, 1;  // here the second state affects the first
  EXPECT_EQ(steady_gain(F, identity(2), first_only, identity(2)).outcome, converged);
  const SteadyGain growing = steady_gain(scalar(-2), scalar(1), scalar(0), scalar(1));
  EXPECT_EQ(growing.outcome, not_detectable);
  EXPECT_HAS(growing.reason, "the mode -2, of magnitude 2");
  const SteadyGain nothing_to_do = steady_gain(scalar(0.5), scalar(1), scalar(0), scalar(1));
  ASSERT_EQ(nothing_to_do.outcome, converged) << nothing_to_do.reason;
  EXPECT_EQ(nothing_to_do.L(0, 0), 0);
}

TEST(SteadyGain, RefusesInvalidCosts) {
  const auto outcome = [](const MatrixXd& Q1, const MatrixXd& Q2) {
    return steady_gain(identity(2), identity(2), Q1, Q2);
  };
  Matrix2d skew;
  skew << 1, 0.1, 0, 1;
  EXPECT_HAS(outcome(skew, identity(2)).reason, "Q1 is not symmetric, by 0.1");
  EXPECT_HAS(outcome(identity(2), skew).reason, "Q2 is not symmetric, by 0.1");
  EXPECT_HAS(outcome(-identity(2), identity(2)).reason, "Q1 has the negative eigenvalue -1");
  EXPECT_HAS(outcome(identity(2), Vector2d(1, 0).asDiagonal()).reason,
             "Q2 has the eigenvalue 0, which is not positive");
  EXPECT_EQ(outcome(skew, identity(2)).outcome, cost_not_definite);
}

TEST(SteadyGain, StopsAtTheIterationLimit) {
  const SteadyGain answer = steady_gain(scalar(1), scalar(1), scalar(1e-6), scalar(1), {.max_iterations = 3});
  EXPECT_EQ(answer.outcome, not_converged);
  EXPECT_EQ(answer.iterations, 3);
  EXPECT_HAS(answer.reason, "after 3 doublings, the cap");
  EXPECT_EQ(answer.T.size(), 0);
}

TEST(SteadyGain, ThrowsForWrongSizesAndNonFiniteEntries) {
  const auto complaint = [](const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1, const MatrixXd& Q2) {
    return message_of<std::invalid_argument>([&] { steady_gain(F, G, Q1, Q2); });
  };
  const MatrixXd I = identity(2);
  EXPECT_EQ(complaint(MatrixXd::Zero(2, 3), I, I, I), "F is 2x3, not 2x2");
  EXPECT_EQ(complaint(I, identity(3), I, I), "G is 3x3, not 2x3");
  EXPECT_EQ(complaint(I, I, identity(3), I), "Q1 is 3x3, not 2x2");
  EXPECT_EQ(complaint(I, I, I, identity(3)), "Q2 is 3x3, not 2x2");
  EXPECT_EQ(complaint(MatrixXd(0, 0), I, I, I), "a system of 0 states and 2 inputs");
  EXPECT_EQ(complaint(I * std::numeric_limits<double>::infinity(), I, I, I),
            "F has an entry that is not finite");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { finite_horizon_gains(I, I, I, I, I, -1); }),
            "a way of -1 steps");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { finite_horizon_gains(I, I, I, I, identity(1), 1); }),
            "T_end is 1x1, not 2x2");
}

TEST(RegulatorOutcome, EachHasAMessage) {
  for (const RegulatorOutcome outcome :
       {converged, cost_not_definite, not_stabilizable, not_detectable, not_converged})
    EXPECT_GT(sentence(outcome).size(), 10u);
}

}  // namespace
}  // namespace incognita
