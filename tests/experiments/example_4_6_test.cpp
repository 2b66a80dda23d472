// The information filter of Example 4.6 against reference solutions, and the findings of its claims.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "experiments/example_4_6_filter.hpp"
#include "experiments/list.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace two_bearings;
using TwoBearings = two_bearings::Setup;  // inside a test, Setup is a name of GoogleTest

MatrixXd some_matrix(RandomStream& random, Eigen::Index rows, Eigen::Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

TEST(ArcTest, IsTheIntegralOfItsSpeeds) {
  const Vector3d from(1, -2, 0.3);
  for (const double rate : {0.0, 1e-5, 0.25, -1.5}) {
    const Vector2d input(1.2, rate);
    Vector3d x = from;
    const int parts = 20000;
    const double h = 0.4 / parts;
    for (int i = 0; i < parts; ++i) {  // midpoint rule
      const double middle = x[2] + 0.5 * h * rate;
      x += h * Vector3d(1.2 * std::cos(middle), 1.2 * std::sin(middle), rate);
    }
    EXPECT_LE((arc(from, input, 0.4).x - x).norm(), 1e-9) << rate;
  }
}

TEST(ArcTest, JacobiansAreDerivatives) {
  const Vector3d from(1, -2, 0.3);
  for (const double rate : {0.0, 1e-5, 3e-4, 0.25, -1.5}) {
    const Vector2d input(1.2, rate);
    const planar::Step step = arc(from, input, 0.4);
    constexpr double h = 1e-5;
    for (int i = 0; i < 3; ++i) {
      const Vector3d d = h * Vector3d::Unit(i);
      EXPECT_LE(
          ((arc(from + d, input, 0.4).x - arc(from - d, input, 0.4).x) / (2 * h) - step.F.col(i)).norm(),
          1e-9)
          << rate;
    }
    for (int i = 0; i < 2; ++i) {
      const Vector2d d = h * Vector2d::Unit(i);
      EXPECT_LE(
          ((arc(from, input + d, 0.4).x - arc(from, input - d, 0.4).x) / (2 * h) - step.G.col(i)).norm(),
          1e-9)
          << rate;
    }
  }
}

TEST(DriveTest, RestsDrivesNorthAndTurnsEast) {
  for (const double dt : {0.05, 0.1, 0.5}) {
    const auto all = drive(dt);
    const auto at = [&](double t) { return all[static_cast<std::size_t>(std::lround(t / dt))]; };
    EXPECT_NEAR(all.back().t_s, 20, 1e-9);
    EXPECT_LE(at(10).pose.norm(), 1e-12);
    EXPECT_LE((at(14).pose - Vector3d(4, 0, 0)).norm(), 1e-9);
    EXPECT_LE((at(20).pose - Vector3d(4 + 4 * std::sin(1.5), 4 - 4 * std::cos(1.5), 1.5)).norm(), 1e-9);
  }
}

TEST(RootInformationTest, EqualsTheInformationFilterForSingularMatricesToo) {
  RandomStream random(1, "matrices");
  for (int run = 0; run < 20; ++run) {
    const MatrixXd H = some_matrix(random, 3, 7), G = some_matrix(random, 7, 2),
                   F = MatrixXd::Identity(7, 7) + 0.3 * some_matrix(random, 7, 7);
    const VectorXd sigmas = Vector2d(0.3, 2);
    RootInformation filter(7);
    filter.measure(H, 0.5);
    EXPECT_LE((filter.matrix() - 4 * H.transpose() * H).norm(), 1e-10);
    const MatrixXd back = F.inverse(), M = 4 * back.transpose() * H.transpose() * H * back;
    const MatrixXd Q_inverse = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
    const MatrixXd inner = G.transpose() * M * G + Q_inverse;
    filter.move(F, G, sigmas);
    EXPECT_LE((filter.matrix() - (M - M * G * inner.inverse() * G.transpose() * M)).norm(), 1e-9 * M.norm());
  }
}

TEST(RootInformationTest, EqualsTheInverseOfTheKalmanFiltersCovariance) {
  RandomStream random(2, "matrices");
  LinearSystem s;
  s.F = MatrixXd::Identity(4, 4) + 0.2 * some_matrix(random, 4, 4);
  s.G = some_matrix(random, 4, 1);
  s.H = some_matrix(random, 2, 4);
  s.Q = 0.25 * MatrixXd::Identity(1, 1);
  s.R = 0.01 * MatrixXd::Identity(2, 2);
  MatrixXd P = 9 * MatrixXd::Identity(4, 4);
  RootInformation filter(4);
  filter.measure(MatrixXd::Identity(4, 4), 3);
  for (int k = 0; k < 20; ++k) {
    P = predicted(s, P);
    P = updated(s, P, kalman_gain(s, P));
    filter.move(s.F, s.G, VectorXd::Constant(1, 0.5));
    filter.measure(s.H, 0.1);
  }
  EXPECT_LE((filter.matrix() * P - MatrixXd::Identity(4, 4)).norm(), 1e-8);
}

TEST(RootInformationTest, WithoutProcessNoiseNoInformationIsLost) {
  RandomStream random(3, "matrices");
  const MatrixXd H = some_matrix(random, 2, 7), G = some_matrix(random, 7, 2),
                 F = MatrixXd::Identity(7, 7) + 0.3 * some_matrix(random, 7, 7);
  RootInformation filter(7);
  filter.measure(H, 1);
  filter.move(F, G, VectorXd::Zero(2));
  EXPECT_LE((F.transpose() * filter.matrix() * F - H.transpose() * H).norm(), 1e-10);
}

TEST(KnowledgeTest, MarginalIsTheLimitOfVanishingPriors) {
  RandomStream random(4, "matrices");
  for (int run = 0; run < 20; ++run) {
    const MatrixXd H = some_matrix(random, 4, states);
    RootInformation filter(states);
    filter.measure(H, 1);
    const Knowledge known(filter.root());
    EXPECT_EQ(known.rank.rank, 4);
    EXPECT_TRUE(known.clear());
    const MatrixXd weak = filter.matrix() + 1e-9 * MatrixXd::Identity(states, states);
    const auto limit = [&](const VectorXd& c) { return 1 / c.dot(weak.inverse() * c); };
    const VectorXd seen = H.transpose() * some_matrix(random, 4, 1), unseen = some_matrix(random, states, 1);
    EXPECT_NEAR(known.marginal(seen) / limit(seen), 1, 1e-5);
    EXPECT_EQ(known.marginal(unseen), 0);
    EXPECT_LT(limit(unseen), 1e-6);
  }
}

TEST(KnowledgeTest, MarginalOfAStateIsTheSchurComplement) {
  RandomStream random(5, "matrices");
  MatrixXd H = some_matrix(random, 5, states);
  H.row(4) = VectorXd::Unit(states, 2).transpose();  // an observable state, in a singular matrix
  RootInformation filter(states);
  filter.measure(H, 0.7);
  const MatrixXd Y = filter.matrix();
  const std::vector<int> others{0, 1, 3, 4, 5, 6};
  const MatrixXd Ymm = Y(others, others);
  const VectorXd Ytm = Y(2, others).transpose();
  const double schur = Y(2, 2) - Ytm.dot(Ymm.completeOrthogonalDecomposition().pseudoInverse() * Ytm);
  EXPECT_NEAR(Knowledge(filter.root()).marginal(VectorXd::Unit(states, 2)), schur, 1e-8 * schur);
}

/// Bearings of both features after each step, as a function of the first state.
VectorXd all_bearings(const VectorXd& first, double dt_s) {
  const auto instants = drive(dt_s);
  Vector3d pose = first.head<3>();
  VectorXd z(2 * static_cast<Eigen::Index>(instants.size()));
  for (std::size_t k = 0; k < instants.size(); ++k) {
    if (k > 0) pose = arc(pose, instants[k].input, dt_s).x;
    for (int i = 0; i < 2; ++i)
      z[2 * static_cast<Eigen::Index>(k) + i] = RangeBearing::h<double>(pose, first.segment<2>(3 + 2 * i))[1];
  }
  return z;
}

// The Fisher information of the first state by central differences of the bearings, without F, H or a filter.
TEST(TwoBearingsTest, RankIsThatOfTheFisherInformation) {
  constexpr double dt = 0.5, h = 1e-4;
  const TwoBearings setup{.dt_s = dt};
  VectorXd first(states);
  first << 0, 0, 0, setup.features.first, setup.features.second;
  const auto instants = drive(dt);
  MatrixXd J(2 * static_cast<Eigen::Index>(instants.size()), states);
  for (int i = 0; i < states; ++i) {
    const VectorXd d = h * VectorXd::Unit(states, i);
    J.col(i) = (all_bearings(first + d, dt) - all_bearings(first - d, dt)) / (2 * h);
  }
  const auto known = course(setup);
  for (const double t : {0.0, 10.0, 14.0, 20.0}) {
    const auto measurements = static_cast<Eigen::Index>(std::lround(t / dt)) + 1;
    const Rank seen = rank_of(J.topRows(2 * measurements), 1e-6);
    EXPECT_GT(seen.gap, 100) << t;
    EXPECT_EQ(known[static_cast<std::size_t>(measurements - 1)].rank.rank, seen.rank) << t;
  }
}

TEST(TwoBearingsTest, GlobalPositionAndHeadingAreUnobservable) {
  const TwoBearings setup;
  const auto known = course(setup);
  const auto instants = drive(setup.dt_s);
  for (std::size_t k = 0; k < known.size(); ++k) {
    VectorXd turn(states);
    const auto& [first, second] = setup.features;
    turn << Vector2d(-instants[k].pose.y(), instants[k].pose.x()) / unit_m, 1,
        Vector2d(-first.y(), first.x()) / unit_m, Vector2d(-second.y(), second.x()) / unit_m;
    const MatrixXd& N = known[k].unobservable;
    EXPECT_LE((turn - N * (N.transpose() * turn)).norm(), 1e-9) << k;
    EXPECT_TRUE(known[k].clear()) << k;
    EXPECT_EQ(known[k].marginal(VectorXd::Unit(states, 2)), 0) << k;
  }
}

TEST(TwoBearingsTest, APriorOnTheHeadingIsInformation) {
  const auto known = course({.sigma_heading_rad = 0.02});
  EXPECT_NEAR(known.front().marginal(VectorXd::Unit(states, 2)), 2500, 1e-6);
  EXPECT_EQ(known.back().rank.rank, 5);
}

TEST(Example46Test, Findings) {
  const testing::Scratch scratch;
  ExperimentSettings settings;
  settings.out = scratch.folder();
  const LedgerEntry entry = example_4_6.run(settings);
  struct Expected {
    Finding truth;
    std::optional<Finding> method;
  };
  constexpr Finding holds = Finding::holds, does_not = Finding::does_not_hold;
  const std::map<std::string, Expected> expected{
      {"4.6-rank", {does_not, holds}},          {"4.6-stationary", {holds, holds}},
      {"4.6-deficiency", {does_not, holds}},    {"4.6-orientation", {does_not, holds}},
      {"4.6-global-modes", {holds, holds}},     {"4.6-relative-at-rest", {holds, holds}},
      {"4.6-relative-2", {does_not, holds}},    {"4.6-line-of-sight", {holds, holds}},
      {"4.6-relative-1", {does_not, does_not}}, {"4.6-relative-features", {does_not, holds}},
      {"4.6-link", {holds, does_not}},          {"4.6-truth", {does_not, std::nullopt}}};
  ASSERT_EQ(entry.claims.size(), expected.size());
  for (const Claim& claim : entry.claims) {
    ASSERT_TRUE(expected.count(claim.id)) << claim.id;
    EXPECT_EQ(claim.finding, expected.at(claim.id).truth) << claim.id << ": " << claim.measured;
    EXPECT_EQ(claim.by_method, expected.at(claim.id).method) << claim.id << ": " << claim.measured;
  }
  ASSERT_EQ(entry.figures.size(), 4U);
  for (const LedgerFigure& figure : entry.figures)
    EXPECT_TRUE(std::filesystem::exists(scratch.folder() / figure.data)) << figure.id;
}

}  // namespace
}  // namespace incognita
