// Linearizations on a unicycle defined here: belief/ does not depend on models/.
#include "incognita/belief/linearize.hpp"
#include "incognita/belief/iterated_update.hpp"

#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

/// A unicycle, linear or not: state x, y, heading; input speed and turn rate.
template <bool linear>
struct Unicycle {
  static constexpr int error_size = 3, input_size = 2;
  template <class S>
  using State = Eigen::Matrix<S, 3, 1>;
  template <class S>
  using Input = Eigen::Matrix<S, 2, 1>;
  static constexpr Chart chart{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}};
  struct Step {
    Eigen::Vector3d x;
    Eigen::Matrix3d F;
    Eigen::Matrix<double, 3, 2> G;
  };
  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    const S heading = linear ? S(0.3) : x[2];
    return {x[0] + dt * u[0] * std::cos(heading),
            x[1] + dt * u[0] * std::sin(heading) + (linear ? dt * x[2] : 0), x[2] + dt * u[1]};
  }
  Step step(const Eigen::Vector3d& x, const Eigen::Vector2d& u, double dt) const {
    Step s{f<double>(x, u, dt), Eigen::Matrix3d::Identity(), Eigen::Matrix<double, 3, 2>::Zero()};
    const double heading = linear ? 0.3 : x[2];
    if (linear) s.F(1, 2) = dt;
    if (!linear) s.F(0, 2) = -dt * u[0] * std::sin(heading), s.F(1, 2) = dt * u[0] * std::cos(heading);
    s.G << dt * std::cos(heading), 0, dt * std::sin(heading), 0, 0, dt;
    return s;
  }
};

Belief vehicle(const Eigen::Vector3d& mean, const Eigen::Matrix3d& P) {
  Belief belief;
  belief.add_vehicle(Unicycle<true>::chart, mean, P);
  return belief;
}

TEST(Unscented, EqualsTheKalmanFilterOnALinearModel) {
  RandomStream random(1, "unscented");
  for (int run = 0; run < 50; ++run) {
    const Belief belief = vehicle({1, 2, 0.4}, 0.02 * random_covariance(random, 3));  // no angle wraps
    const Eigen::Matrix2d Q = 0.02 * random_covariance(random, 2);
    const LinearizedMotion a = linearized(Unicycle<true>(), belief, 0, {1, 0.5}, Q, 0.3);
    const LinearizedMotion u = unscented(Unicycle<true>(), belief, 0, {1, 0.5}, Q, 0.3);
    EXPECT_TRUE(close(u.x_next, a.x_next, 1e-12));
    EXPECT_TRUE(close(u.A, a.A, 1e-9));
    EXPECT_TRUE(close(u.N, a.N, 1e-9));
  }
}

TEST(Unscented, AcceptsAVehicleWithZeroCovariance) {
  const Belief belief = vehicle({0, 0, 3.0}, Eigen::Matrix3d::Zero());
  const Eigen::Matrix2d Q = Eigen::Vector2d(0.04, 0.01).asDiagonal();
  const LinearizedMotion u = unscented(Unicycle<false>(), belief, 0, {1, 0.5}, Q, 0.1);
  const LinearizedMotion a = linearized(Unicycle<false>(), belief, 0, {1, 0.5}, Q, 0.1);
  ASSERT_TRUE(u.A.allFinite());
  EXPECT_TRUE(close(u.x_next, a.x_next, 1e-12));
  EXPECT_TRUE(close(u.N, a.N, 1e-12));
}

/// Sample mean and covariance of f of a Gaussian.
TEST(Unscented, IsNearerTheTrueMomentsThanFirstOrder) {
  const Eigen::Matrix3d P = Eigen::Vector3d(0.01, 0.01, 0.25).asDiagonal();
  const Belief belief = vehicle({0, 0, 0.2}, P);
  const Eigen::Vector2d u(2, 0.1);
  const Eigen::Matrix2d Q = Eigen::Matrix2d::Zero();
  RandomStream random(5, "drawn");
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  constexpr int draws = 200000;
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector3d x(0.1 * random.normal(), 0.1 * random.normal(), 0.2 + 0.5 * random.normal());
    mean += Unicycle<false>().f<double>(x, u, 1).head<2>() / draws;
  }
  const double by_first = (linearized(Unicycle<false>(), belief, 0, u, Q, 1).x_next.head(2) - mean).norm();
  const double by_points = (unscented(Unicycle<false>(), belief, 0, u, Q, 1).x_next.head(2) - mean).norm();
  EXPECT_LT(by_points, 0.05 * by_first) << mean.transpose();
}

TEST(Unscented, DoesNotShrinkAnUnconstrainedHeading) {
  for (const double sigma : {1.0, 2.0, 6.0}) {
    const Eigen::Matrix3d P = Eigen::Vector3d(1e10, 1e10, sigma * sigma).asDiagonal();
    Belief belief = vehicle({0, 0, 0.2}, P);
    const LinearizedMotion u =
        unscented(Unicycle<false>(), belief, 0, {1, 0.5}, 1e-6 * Eigen::Matrix2d::Identity(), 0.1);
    EXPECT_NEAR(u.A(2, 2), 1, 1e-9) << sigma;
    belief.predict(u);
    EXPECT_GE(belief.covariance(0)(2, 2), sigma * sigma * (1 - 1e-9)) << sigma;
  }
}

TEST(Unscented, KeepsTheWholeCovariancePositive) {
  RandomStream random(7, "cross");
  Belief belief = vehicle({0, 0, 0.2}, random_covariance(random, 3));
  const Belief::Parent parent{0, Eigen::Matrix<double, 2, 3>::Ones()};
  belief.augment(Chart::line(2), Eigen::Vector2d(3, 4), {&parent, 1}, Eigen::Matrix2d::Identity());
  const Eigen::Matrix2d Q = 0.01 * Eigen::Matrix2d::Identity();
  const LinearizedMotion motion = unscented(Unicycle<false>(), belief, 0, {1, 0.3}, Q, 0.5);
  belief.predict(motion);
  EXPECT_TRUE(positive_definite(belief.dense_covariance()));
}

/// A range to a known point, strongly nonlinear for an uncertain vehicle.
LinearizedMeasurement range_measurement(const Belief& belief, double measured) {
  const Eigen::Vector2d to_place = Eigen::Vector2d(2, 0) - belief.mean(0).head<2>();
  LinearizedMeasurement measurement;
  Eigen::RowVector3d H;
  H << -to_place.transpose() / to_place.norm(), 0;
  measurement.add(0, H);
  measurement.residual = Eigen::VectorXd::Constant(1, measured - to_place.norm());
  measurement.R = Eigen::MatrixXd::Constant(1, 1, 1e-4);
  return measurement;
}

TEST(Iterated, ConvergesToTheMapEstimate) {
  const Eigen::Matrix3d P = Eigen::Vector3d(1, 0.1, 0.1).asDiagonal();  // not along the line of sight
  const Eigen::Vector3d prior(0.3, 0.8, 0);
  Belief belief = vehicle(prior, P);
  const BlockId blocks[] = {0};
  const IterationReport report = update_iterated(
      belief, blocks,
      [](const Belief& b) { return std::vector<LinearizedMeasurement>{range_measurement(b, 1.0)}; },
      {100, 1e-12});
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.iterations, 1);
  const auto cost = [&](const Eigen::Vector3d& x) {
    const double r = 1.0 - (Eigen::Vector2d(2, 0) - x.head<2>()).norm();
    return (x - prior).dot(P.inverse() * (x - prior)) + r * r / 1e-4;
  };
  const Eigen::Vector3d best = belief.mean(0);
  RandomStream random(3, "nearby");
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d step = 1e-3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    EXPECT_GE(cost(best + step), cost(best) - 1e-9);
  }
}

TEST(Iterated, ReportsTheCapOfIterations) {
  Belief belief = vehicle({0.3, 0.8, 0}, Eigen::Vector3d(1, 0.1, 0.1).asDiagonal());
  const BlockId blocks[] = {0};
  const IterationReport report = update_iterated(
      belief, blocks,
      [](const Belief& b) { return std::vector<LinearizedMeasurement>{range_measurement(b, 1.0)}; },
      {2, 1e-15});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 2);
  EXPECT_EQ(report.update.outcome, UpdateReport::Outcome::updated);
}

TEST(Iterated, EqualsTheOrdinaryUpdateOfALinearMeasurement) {
  RandomStream random(11, "linear look");
  Map map(random, {3}, {2, 2, 2});
  Belief once = map.belief;
  const std::vector<BlockId> blocks{map.vehicles[0], map.landmarks[1]};
  const LinearizedMeasurement fixed = random_measurement(random, once, 2, blocks);
  const std::vector<BlockId> ids{map.vehicles[0], map.landmarks[0], map.landmarks[1], map.landmarks[2]};
  const Eigen::VectorXd prior = stacked_mean(map.belief, ids);
  const auto measurements = [&](const Belief& b) {  // its residual falls as the means move towards it
    LinearizedMeasurement measurement = fixed;
    const Eigen::VectorXd moved = stacked_mean(b, ids) - prior;
    for (int part = 0; part < measurement.part_count; ++part) {
      const int at = b.offset(measurement.parts[part].block);
      measurement.residual -= measurement.parts[part].H * moved.segment(at, measurement.parts[part].H.cols());
    }
    return std::vector<LinearizedMeasurement>{measurement};
  };
  const IterationReport report = update_iterated(map.belief, blocks, measurements);
  once.update({&fixed, 1});
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(close(stacked_mean(map.belief, ids), stacked_mean(once, ids), 1e-10));
  EXPECT_TRUE(close(map.belief.dense_covariance(), once.dense_covariance(), 1e-12));
}

}  // namespace
}  // namespace incognita::testing
