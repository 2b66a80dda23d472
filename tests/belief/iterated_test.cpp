// The iterated update of a body with rotation finds the maximum a posteriori state, as an independent
// optimizer does.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "incognita/belief/iterated_update.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Pose = Eigen::Matrix<double, 7, 1>;   // position, world_from_body
using Error = Eigen::Matrix<double, 6, 1>;  // of position and rotation, the rotation error on the right

constexpr Chart pose_chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};
constexpr double sigma_m = 0.05;

Pose plus(Pose x, Error e) {
  pose_chart.plus(numbers(x), numbers(e));
  return x;
}
Error minus(Pose y, Pose x) {
  Error e;
  pose_chart.minus(numbers(y), numbers(x), numbers(e));
  return e;
}

/// A body with an uncertain rotation measures known points in its own axes, with noise.
struct Scene {
  Pose prior = Pose::Zero();
  Eigen::Matrix<double, 6, 6> P;
  std::vector<Vector3d> points, measured;

  explicit Scene(std::uint64_t seed) {
    RandomStream random(seed, "turned");
    const auto drawn = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
    prior[3] = 1;
    const Eigen::Matrix<double, 6, 6> root =
        Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return random.normal(); });
    P = 0.05 * root * root.transpose() + 0.01 * Eigen::Matrix<double, 6, 6>::Identity();
    P.block<3, 3>(3, 3) += 0.5 * Matrix3d::Identity();
    Error off;
    off << 0.2 * drawn(), 0.5 * drawn();
    const Pose truth = plus(prior, off);
    for (int i = 0; i < 2; ++i) {  // two points leave the rotation about their line to the prior
      points.push_back(3 * drawn());
      measured.push_back(seen(truth, points.back()) + sigma_m * drawn());
    }
  }

  static Vector3d seen(const Pose& x, const Vector3d& point) {
    return rotation_matrix<double>(x.tail<4>()).transpose() * (point - x.head<3>());
  }

  Belief belief() const {
    Belief b;
    b.add_vehicle(pose_chart, prior, P);
    return b;
  }

  std::vector<LinearizedMeasurement> measurements(const Belief& b) const {
    const Pose x = b.mean(0);
    std::vector<LinearizedMeasurement> all;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d c = seen(x, points[i]);
      Eigen::Matrix<double, 3, 6> H;
      H << -rotation_matrix<double>(x.tail<4>()).transpose(), skew<double>(c);
      LinearizedMeasurement measurement;
      measurement.add(0, H);
      measurement.residual = measured[i] - c;
      measurement.R = sigma_m * sigma_m * Matrix3d::Identity();
      all.push_back(measurement);
    }
    return all;
  }

  /// Residuals of prior and measurements, each whitened: the MAP state minimizes their squared norm.
  Eigen::VectorXd costs(const Error& e) const {
    const Pose x = plus(prior, e);
    Eigen::VectorXd all(6 + 3 * points.size());
    all.head<6>() = P.llt().matrixL().solve(e);
    for (std::size_t i = 0; i < points.size(); ++i)
      all.segment<3>(6 + 3 * static_cast<Eigen::Index>(i)) = (measured[i] - seen(x, points[i])) / sigma_m;
    return all;
  }

  /// By Levenberg-Marquardt in the prior's chart with finite differences: independent of the code under test
  /// but for the cost.
  Error most_probable() const {
    Error e = Error::Zero();
    double damping = 1e-3;
    for (int step = 0; step < 500; ++step) {
      const Eigen::VectorXd m = costs(e);
      Eigen::MatrixXd J(m.size(), 6);
      for (int k = 0; k < 6; ++k)
        J.col(k) = (costs(e + 1e-6 * Error::Unit(k)) - costs(e - 1e-6 * Error::Unit(k))) / 2e-6;
      Eigen::Matrix<double, 6, 6> A = J.transpose() * J;
      A.diagonal() *= 1 + damping;
      const Error next = e - A.ldlt().solve(J.transpose() * m);
      const bool better = costs(next).squaredNorm() < m.squaredNorm();
      damping *= better ? 0.3 : 4;
      if (better) e = next;
    }
    return e;
  }
};

TEST(IteratedUpdate, OfARotatedBodyIsTheMapEstimate) {
  constexpr BlockId blocks[] = {0};
  double farthest_turn = 0, apart_after_one = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    Belief belief = scene.belief(), once = scene.belief();
    const auto linearize_at = [&](const Belief& b) { return scene.measurements(b); };
    const IterationReport report = update_iterated(belief, blocks, linearize_at, {200, 1e-10});
    EXPECT_TRUE(report.converged) << seed;
    const Error best = scene.most_probable(), found = minus(belief.mean(0), scene.prior);
    EXPECT_LE((found - best).norm(), 1e-6) << seed;
    once.update(scene.measurements(once));
    apart_after_one = std::max(apart_after_one, (minus(once.mean(0), scene.prior) - best).norm());
    farthest_turn = std::max(farthest_turn, best.tail<3>().norm());
  }
  EXPECT_GT(farthest_turn, 0.5) << "far enough for the chart to be nonlinear";
  EXPECT_GT(apart_after_one, 0.05) << "one linearization is not enough";
}

TEST(IteratedUpdate, StopsWhenAChangeIsSmallAgainstTheSigma) {
  const Scene scene(3);
  constexpr BlockId blocks[] = {0};
  const auto linearize_at = [&](const Belief& b) { return scene.measurements(b); };
  Belief fine = scene.belief(), coarse = scene.belief();
  const IterationReport all = update_iterated(fine, blocks, linearize_at, {200, 1e-10});
  const IterationReport few = update_iterated(
      coarse, blocks, linearize_at, {.max_iterations = 200, .tolerance = 1e-10, .tolerance_sigmas = 1e-2});
  EXPECT_TRUE(few.converged);
  EXPECT_LT(few.iterations, all.iterations);
  const Error apart = minus(coarse.mean(0), fine.mean(0));
  EXPECT_LE((apart.array().abs() / scene.P.diagonal().array().sqrt()).maxCoeff(), 1e-2);
}

/// A measurement that becomes undefined at an iterate keeps its last linearization.
TEST(IteratedUpdate, KeepsAMeasurementThatBecomesUndefined) {
  const Scene scene(5);
  constexpr BlockId blocks[] = {0};
  int asked = 0;
  const auto second_lost = [&](const Belief& b) {
    std::vector<LinearizedMeasurement> measurements = scene.measurements(b);
    if (asked++ > 0) measurements[1] = LinearizedMeasurement{};
    return measurements;
  };
  Belief belief = scene.belief();
  EXPECT_TRUE(update_iterated(belief, blocks, second_lost, {200, 1e-10}).converged);
  // As if it had been linear from the start
  Belief wanted = scene.belief();
  const LinearizedMeasurement linear = scene.measurements(wanted)[1];
  const Belief at_prior = scene.belief();
  const auto second_linear = [&](const Belief& b) {
    std::vector<LinearizedMeasurement> measurements = scene.measurements(b);
    const Pose x = b.mean(0);
    const Error moved = minus(x, scene.prior);
    measurements[1] = linear;
    // derivative of H (x (+) e (-) x_0) with respect to e
    Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
    J.block<3, 3>(3, 3) = right_jacobian(moved.tail<3>()).inverse();
    measurements[1].residual -= linear.parts[0].H * moved;
    measurements[1].parts[0].H = linear.parts[0].H * J;
    return measurements;
  };
  EXPECT_TRUE(update_iterated(wanted, blocks, second_linear, {200, 1e-10}).converged);
  EXPECT_LE(minus(belief.mean(0), wanted.mean(0)).norm(), 1e-7);
}

}  // namespace
}  // namespace incognita
