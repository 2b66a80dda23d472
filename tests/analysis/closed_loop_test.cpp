// The closed loop of thesis (5.5) against plant and filter simulated side by side.
#include "incognita/analysis/observability/closed_loop.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/math/random.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::message_of;

MatrixXd random_matrix(RandomStream& random, Eigen::Index rows, Eigen::Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

struct Loop {
  ControlledSystem system;
  MatrixXd L, K;
};

Loop random_loop(RandomStream& random) {
  const int n = 1 + random.below(5), m = 1 + random.below(3), p = 1 + random.below(3);
  return {{0.6 * random_matrix(random, n, n), random_matrix(random, n, m), random_matrix(random, p, n)},
          0.3 * random_matrix(random, m, n),
          0.3 * random_matrix(random, n, p)};
}

TEST(ClosedLoop, EqualsPlantAndFilterSimulatedSeparately) {
  RandomStream random(1, "loops");
  for (int i = 0; i < 50; ++i) {
    const auto [s, L, K] = random_loop(random);
    const Eigen::Index n = s.F.rows();
    const MatrixXd A = closed_loop_matrix(s, L, K), B = closed_loop_noise(s, K);
    VectorXd x = random_matrix(random, n, 1), x_hat = random_matrix(random, n, 1), state(2 * n);
    state << x, x - x_hat;
    for (int k = 0; k < 5; ++k) {
      const VectorXd v = random_matrix(random, s.G.cols(), 1), w = random_matrix(random, s.H.rows(), 1);
      const VectorXd u = -L * x_hat;
      x = s.F * x + s.G * (u + v);
      const VectorXd z = s.H * x + w;  // at k + 1, after the move
      const VectorXd expected = s.F * x_hat + s.G * u;
      x_hat = expected + K * (z - s.H * expected);
      state = A * state + B * (VectorXd(v.size() + w.size()) << v, w).finished();
      const double size = std::max(1.0, state.norm());
      EXPECT_LE((state.head(n) - x).norm(), 1e-12 * size);
      EXPECT_LE((state.tail(n) - (x - x_hat)).norm(), 1e-12 * size);
    }
  }
}

TEST(ClosedLoop, EigenvaluesAreThoseOfRegulatorAndFilter) {
  RandomStream random(2, "loops");
  for (int i = 0; i < 200; ++i) {
    const auto [s, L, K] = random_loop(random);
    const Separation answer = separation(s, s, L, K);
    EXPECT_TRUE(answer.holds) << answer.spectral_distance;
    EXPECT_LE(answer.coupling, 1e-14);
    EXPECT_NEAR(answer.whole.spectral_radius,
                std::max(answer.regulator.spectral_radius, answer.estimator.spectral_radius), 1e-6);
    const MatrixXd as_printed = closed_loop_matrix(s, L, K);
    EXPECT_NEAR(stability_of(as_printed).spectral_radius, answer.whole.spectral_radius, 1e-6);
  }
}

TEST(ClosedLoop, SeparationFailsWhenTheFilterIsLinearizedElsewhere) {
  RandomStream random(3, "loops");
  for (int i = 0; i < 50; ++i) {
    const auto [plant, L, K] = random_loop(random);
    ControlledSystem filter = plant;
    filter.F += 0.1 * random_matrix(random, plant.F.rows(), plant.F.cols());
    const Separation answer = separation(plant, filter, L, K);
    EXPECT_FALSE(answer.holds);
    EXPECT_GT(answer.coupling, 1e-4);
    EXPECT_GT(answer.spectral_distance, 1e-5);
  }
}

/// Regulator and filter are each stable, their loop is not once the filter assumes a wrong gain of the plant.
TEST(ClosedLoop, CanBeUnstableThoughBothPartsAreStable) {
  const auto scalar = [](double value) { return MatrixXd::Constant(1, 1, value); };
  const ControlledSystem filter{scalar(1), scalar(1), scalar(1)}, plant{scalar(1), scalar(3), scalar(1)};
  const Separation answer = separation(plant, filter, scalar(0.9), scalar(0.9));
  EXPECT_TRUE(answer.regulator);
  EXPECT_TRUE(answer.estimator);
  EXPECT_FALSE(answer.whole);
  EXPECT_FALSE(answer.holds);
}

TEST(ClosedLoop, SteadyStateFilterHasTheErrorDynamicsMatrix) {
  const LinearSystem monobot{MatrixXd::Identity(1, 1), MatrixXd::Ones(1, 1), -MatrixXd::Ones(1, 1),
                             0.09 * MatrixXd::Ones(1, 1), 0.04 * MatrixXd::Ones(1, 1)};
  const RiccatiLimit limit = iterate_riccati(monobot, MatrixXd::Ones(1, 1));
  const ControlledSystem s{monobot.F, monobot.G, monobot.H};
  const Separation answer = separation(s, s, MatrixXd::Constant(1, 1, 0.5), limit.K);
  EXPECT_NEAR(answer.estimator.spectral_radius, std::abs(error_dynamics(monobot, limit.K)(0, 0)), 1e-15);
  EXPECT_TRUE(answer.whole);
}

TEST(Stability, SpectralRadiusDecides) {
  const MatrixXd F = Eigen::Vector2d(1.5, 0.2).asDiagonal(), G = Eigen::Vector2d(1, 0);
  EXPECT_FALSE(is_stabilizing(F, G, Eigen::RowVector2d(0, 0)));
  EXPECT_NEAR(is_stabilizing(F, G, Eigen::RowVector2d(0, 0)).spectral_radius, 1.5, 1e-15);
  EXPECT_TRUE(is_stabilizing(F, G, Eigen::RowVector2d(1, 0)));
  EXPECT_FALSE(stability_of(MatrixXd::Identity(2, 2))) << "the unit circle is not inside";
  EXPECT_FALSE(stability_of(MatrixXd::Constant(2, 2, NAN))) << "NaN is not stable";
  EXPECT_TRUE(stability_of(MatrixXd(0, 0)));
}

TEST(ClosedLoop, RefusalNamesTheWrongSize) {
  const MatrixXd I = MatrixXd::Identity(2, 2), three = MatrixXd::Identity(3, 3);
  const auto complaint = [](auto action) { return message_of<std::invalid_argument>(action); };
  EXPECT_EQ(complaint([&] { is_stabilizing(I, I, three); }), "L is 3x3, not 2x2");
  EXPECT_EQ(complaint([&] { closed_loop_matrix({I, I, three}, I, I); }), "H is 3x3, not 3x2");
  EXPECT_EQ(complaint([&] { closed_loop_noise({I, I, I}, three); }), "K is 3x3, not 2x2");
  EXPECT_EQ(complaint([&] { stability_of(MatrixXd(2, 3)); }), "A is 2x3, not 2x2");
  const MatrixXd tall(3, 2);
  EXPECT_EQ(complaint([&] {
              separation({I, I, I}, {three, tall, tall.transpose()}, I, I);
            }),
            "L is 2x2, not 2x3");
}

}  // namespace
}  // namespace incognita
