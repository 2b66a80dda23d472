#include "incognita/slam/mapper/entropy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "incognita/math/random.hpp"
#include "tests/allocations.hpp"

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

/// Lasting errors of matches are part of the state, but the entropies are of poses and map.
TEST(Entropies, AreNotOfLastingErrors) {
  RandomStream random(2, "lasting");
  Estimate estimate;
  FreeCameraMotion::State<double> x = FreeCameraMotion::State<double>::Zero();
  x[3] = 1;
  const BlockId camera = estimate.bodies.emplace_back().block =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, x, 0.01 * Eigen::MatrixXd::Identity(12, 12));
  for (int i = 0; i < 3; ++i)
    estimate.lasting_errors.push_back(estimate.belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(),
                                                                  0.1 * Eigen::Matrix2d::Identity()));
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < 12 + 6 + 4 * 3; ++i)
    if (i < 12 || i >= 18) kept.push_back(i);
  for (int i = 0; i < 4; ++i) {
    const Belief::Parent parents[] = {
        {camera, BlockMatrix(random_matrix(3, 12, random))},
        {estimate.lasting_errors[static_cast<std::size_t>(i) % 3], BlockMatrix(random_matrix(3, 2, random))}};
    estimate.belief.augment(Chart::line(3), Eigen::Vector3d(i, 1, 2), parents,
                            0.02 * Eigen::Matrix3d::Identity());
  }
  const Eigen::MatrixXd P = estimate.belief.dense_covariance()(kept, kept);
  const Entropy entropy = entropies(estimate);
  EXPECT_NEAR(entropy.vehicle, dense_entropy(P.topLeftCorner(12, 12)), 1e-8);
  EXPECT_NEAR(entropy.map, dense_entropy(P.bottomRightCorner(12, 12)), 1e-8);
  EXPECT_NEAR(entropy.total, dense_entropy(P), 1e-8);
}

/// The same of a state whose entropies take many frames.
TEST(RunningEntropy, IsNotOfLastingErrors) {
  const auto estimate_with = [](bool lasting) {
    Estimate estimate;
    FreeCameraMotion::State<double> x = FreeCameraMotion::State<double>::Zero();
    x[3] = 1;
    const BlockId camera = estimate.bodies.emplace_back().block =
        estimate.belief.add_vehicle(FreeCameraMotion::chart, x, 0.01 * Eigen::MatrixXd::Identity(12, 12));
    for (int i = 0; lasting && i < 20; ++i)
      estimate.lasting_errors.push_back(estimate.belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(),
                                                                    0.1 * Eigen::Matrix2d::Identity()));
    RandomStream random(3, "map");
    for (int i = 0; i < 150; ++i) {
      const Belief::Parent parent{camera, BlockMatrix(random_matrix(3, 12, random))};
      estimate.belief.augment(Chart::line(3), Eigen::Vector3d(i, 1, 2), {&parent, 1},
                              Eigen::Matrix3d::Identity());
    }
    RunningEntropy running;
    for (int frame = 0; frame < 100 && !(estimate.entropy_t && *estimate.entropy_t == 5); ++frame)
      running.update(estimate, 5 + frame / 200.);
    return estimate;
  };
  const Estimate without = estimate_with(false), with = estimate_with(true);
  ASSERT_GT(without.belief.errors(), RunningEntropy::max_errors_at_once);
  ASSERT_TRUE(without.entropy_t && with.entropy_t);
  EXPECT_NEAR(with.entropy.map, without.entropy.map, 1e-8);
  EXPECT_NEAR(with.entropy.total, without.entropy.total, 1e-8);
  EXPECT_NEAR(with.entropy.total, entropies(without).total, 1e-8);
}

TEST(Entropies, WithoutAMapAllIsTheCamera) {
  const Entropy entropy = entropies(camera_and_points(0));
  EXPECT_EQ(entropy.map, 0);
  EXPECT_NEAR(entropy.total, entropy.vehicle, 1e-12);
}

/// A small measurement of the camera, so that the belief changes between ticks.
void measure_camera(Estimate& estimate) {
  LinearizedMeasurement measurement;
  measurement.add(estimate.bodies[0].block, Eigen::MatrixXd::Identity(1, 12));
  measurement.residual = Eigen::Matrix<double, 1, 1>(0.01);
  measurement.R = Eigen::Matrix<double, 1, 1>(0.5);
  estimate.belief.update({&measurement, 1});
}

TEST(RunningEntropy, OfASmallStateIsRefreshedAtOnceAndOnceASecond) {
  Estimate estimate = camera_and_points(9);
  RunningEntropy running;
  running.update(estimate, 5);
  const Entropy first = estimate.entropy, dense = entropies(estimate);
  EXPECT_EQ(first.total, dense.total);
  EXPECT_EQ(first.map, dense.map);
  EXPECT_EQ(estimate.entropy_t, 5);
  measure_camera(estimate);
  running.update(estimate, 5.9);
  EXPECT_EQ(estimate.entropy.total, first.total);
  EXPECT_EQ(estimate.entropy.vehicle, vehicle_entropy(estimate)) << "that of the bodies at each tick";
  running.update(estimate, 6);
  EXPECT_EQ(estimate.entropy.total, entropies(estimate).total);
  EXPECT_EQ(estimate.entropy_t, 6);
}

/// Ticks until the entropies of the state at the first one are known, at 10 Hz from `t`.
int ticks_until_done(RunningEntropy& running, Estimate& estimate, double t) {
  int ticks = 0;
  do {
    running.update(estimate, t + 0.1 * ticks++);
    measure_camera(estimate);
  } while (estimate.entropy_t != t && ticks < 10000);
  return ticks;
}

TEST(RunningEntropy, OfALargeStateIsThatOfTheTimeItStatesThoughTheBeliefWentOn) {
  Estimate estimate = camera_and_points(200);
  ASSERT_GT(estimate.belief.errors(), RunningEntropy::max_errors_at_once);
  RunningEntropy running;
  for (const double t : {3.0, 20.0}) {
    const Entropy then = entropies(estimate);
    const int ticks = ticks_until_done(running, estimate, t);
    const long steps = TiledCholesky::steps_of(estimate.belief.errors()),
               per_tick = RunningEntropy::steps_per_tick(estimate.belief.errors());
    EXPECT_EQ(ticks, (steps + per_tick - 1) / per_tick);
    EXPECT_NEAR(estimate.entropy.map, then.map, 1e-9 * std::abs(then.map));
    EXPECT_NEAR(estimate.entropy.total, then.total, 1e-9 * std::abs(then.total));
    EXPECT_NE(estimate.entropy.total, entropies(estimate).total);
  }
}

TEST(RunningEntropy, SharesTheWorkOfALargeStateEvenly) {
  const int errors = 3266;  // 1,633 landmarks on a plane
  const long steps = RunningEntropy::steps_per_tick(errors);
  EXPECT_LE(steps * 2.0 * std::pow(TiledCholesky::tile, 3), 1.2 * errors * static_cast<double>(errors));
  EXPECT_LT(TiledCholesky::steps_of(errors) / steps, errors / 2);
}

using EntropyAllocation = testing::Allocation;

TEST_F(EntropyAllocation, IsAbsentAfterTheLargestState) {
  for (const int points : {20, 200}) {
    Estimate estimate = camera_and_points(points);
    RunningEntropy running;
    ticks_until_done(running, estimate, 0);
    EXPECT_EQ(testing::allocations_in([&] {
                for (int i = 0; i < 200; ++i) running.update(estimate, 100 + 0.1 * i);
              }),
              0)
        << points;
    EXPECT_GE(*estimate.entropy_t, 100);
  }
}

}  // namespace
}  // namespace incognita
