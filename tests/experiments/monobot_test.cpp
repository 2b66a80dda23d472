// The monobot's filter against matrix equations, and the verdicts of the linear examples.
#include "experiments/monobot.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <map>
#include <optional>

#include "experiments/list.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using monobot::Decorrelated;
using MonobotSetup = monobot::Setup;  // inside a test, Setup is a name of GoogleTest

MatrixXd first_prior(const MonobotSetup& setup) {
  return predicted(monobot::system(setup), monobot::first_covariance(setup));
}

TEST(MonobotFilter, FollowsTheRiccatiEquation) {
  for (const bool anchored : {false, true})
    for (const int n : {1, 3}) {
      const MonobotSetup setup{.landmarks = n, .anchored = anchored};
      const auto course = monobot::course(setup);
      for (const int k : {1, 2, 10, 100}) {
        const RiccatiLimit riccati = iterate_riccati(monobot::system(setup), first_prior(setup),
                                                     {.max_iterations = k, .tolerance = 0});
        EXPECT_LE((riccati.K - course.gain[k]).norm(), 1e-12) << k;
        EXPECT_LE((riccati.P - predicted(monobot::system(setup), course.posterior[k])).norm(), 1e-12) << k;
      }
    }
}

TEST(MonobotFilter, StartsAtItsSetup) {
  const MatrixXd known = monobot::first_covariance({.landmarks = 2});
  EXPECT_EQ(known, MatrixXd(Eigen::Vector3d(0, 1, 1).asDiagonal()));
  const MatrixXd initialized = monobot::first_covariance({.robot_var_m2 = 0.25, .landmark_var_m2 = {}});
  EXPECT_NEAR(initialized(1, 1), 0.25 + 0.04, 1e-15);
  EXPECT_NEAR(initialized(0, 1), 0.25, 1e-15);
}

TEST(MonobotFilter, ConvergesToTheClosedForm) {
  for (const int n : {1, 2, 5})
    for (const double robot_var : {0.0, 0.5})
      for (const std::optional<double> landmark_var : {std::optional(1.0), std::optional<double>()}) {
        const MonobotSetup setup{
            .landmarks = n, .steps = 500, .robot_var_m2 = robot_var, .landmark_var_m2 = landmark_var};
        const MatrixXd P = monobot::course(setup).prior[500], limit = monobot::settled_prior(setup);
        EXPECT_NEAR(P(0, 0), limit(0, 0), 1e-9);
        EXPECT_NEAR(P(0, 1), limit(0, 1), 1e-9);
        EXPECT_NEAR(P(1, 1), limit(1, 1), 0.04 / 500) << "differences of landmarks go as one over steps";
      }
}

TEST(MonobotFilter, DecorrelatesConservativelyBeforeTheUpdate) {
  for (const auto what : {Decorrelated::everything, Decorrelated::map}) {
    const auto course = monobot::course({.landmarks = 3, .decorrelated = what, .steps = 20});
    for (int k = 1; k <= 20; ++k) {
      const MatrixXd P = course.prior[k], map = P.bottomRightCorner(3, 3);
      EXPECT_TRUE(MatrixXd(map - MatrixXd(map.diagonal().asDiagonal())).isZero(0));
      EXPECT_EQ(P.row(0).tail(3).isZero(0), what == Decorrelated::everything || k == 1);
      const auto eigen = Eigen::SelfAdjointEigenSolver<MatrixXd>(course.inflation[k], Eigen::EigenvaluesOnly);
      EXPECT_GE(eigen.eigenvalues()[0], -1e-15);
    }
  }
}

TEST(MonobotFilter, CovarianceIsExactUnlessInflated) {
  const MonobotSetup plain{.landmarks = 2}, dropped{.landmarks = 2, .decorrelated = Decorrelated::map};
  const auto course = monobot::course(plain), inflated = monobot::course(dropped);
  EXPECT_LE((monobot::actual_covariances(plain, course)[100] - course.posterior[100]).norm(), 1e-14);
  EXPECT_LT(monobot::actual_covariances(dropped, inflated)[100].trace(),
            0.99 * inflated.posterior[100].trace());
}

TEST(MonobotRun, NoiseDependsOnTheSeedAlone) {
  const auto one = monobot::simulate({}, 3), many = monobot::simulate({.landmarks = 4, .anchored = true}, 3);
  EXPECT_EQ(one.truth.row(0), many.truth.row(0));
  EXPECT_LE((one.measurement.row(0) - many.measurement.row(1)).rightCols(100).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(one.estimate, monobot::simulate({}, 3).estimate);
  EXPECT_NE(one.truth.row(0), monobot::simulate({}, 4).truth.row(0));
  EXPECT_EQ(one.truth(0, 0), -1);
  EXPECT_TRUE((one.truth.row(1).array() == 1).all());
}

TEST(MonobotRun, VariancesEqualThoseOfTheCourse) {
  const MonobotSetup setup{.landmarks = 2, .anchored = true};
  const auto run = monobot::simulate(setup, 1);
  const auto course = monobot::course(setup);
  for (const int k : {0, 1, 100})
    EXPECT_LE((run.variance.col(k) - course.posterior[k].diagonal()).norm(), 1e-15) << k;
  const Eigen::VectorXd e = run.error().col(100);
  EXPECT_NEAR(run.nees[100], e.dot(course.posterior[100].inverse() * e) / 3, 1e-9);
}

TEST(MonobotFigure, HasFourRowsAndTwoColumns) {
  const Plot plot = monobot::four_rows("fig-3.8", "", {.anchored = true});
  ASSERT_EQ(plot.panels.size(), 8u);
  EXPECT_EQ(plot.columns, 2);
  EXPECT_EQ(plot.panels[6].curves.size(), 4u) << "robot and landmark, by anchor and landmark";
  EXPECT_EQ(plot.panels[7].curves.size(), 5u);
}

TEST(MonobotNoise, ExcitedRankCountsNoiseAndInflation) {
  const MonobotSetup setup{.landmarks = 2};
  EXPECT_EQ(monobot::excited(setup, MatrixXd::Zero(3, 3)).rank, 1);
  const Eigen::Vector3d difference(0, 1, -1);
  EXPECT_EQ(monobot::excited(setup, 1e-6 * difference * difference.transpose()).rank, 2);
  const LinearSystem noisy = monobot::with_pseudo_noise(monobot::system(setup), MatrixXd::Identity(3, 3));
  const MatrixXd noise = noisy.G * noisy.Q * noisy.G.transpose();
  EXPECT_LE((noise - MatrixXd(Eigen::Vector3d(1.01, 1, 1).asDiagonal())).norm(), 1e-15);
}

// Verdicts --------------------------------------------------------------------------------------------

constexpr const char *yes = "holds", *misprint = "misprint", *holds_if = "holds-if", *no = "does-not-hold";

using Verdicts = std::map<std::string, std::string>;

void expect_verdicts(const Experiment& experiment, const Verdicts& expected) {
  const testing::Scratch scratch;
  std::filesystem::create_directories(scratch / "figures");
  const LedgerEntry entry = experiment.run({scratch.folder(), ExperimentSettings{}.seeds, {}});
  EXPECT_EQ(entry.id, experiment.id);
  Verdicts found;
  for (const Claim& claim : entry.claims) {
    EXPECT_TRUE(found.emplace(claim.id, name(claim.finding)).second) << claim.id << " occurs twice";
    EXPECT_FALSE(claim.place.empty() || claim.statement.empty() || claim.measured.empty()) << claim.id;
    EXPECT_EQ(claim.why.empty(), claim.finding == Finding::holds) << claim.id;
    const auto wanted = expected.find(claim.id);
    ASSERT_NE(wanted, expected.end()) << claim.id;
    EXPECT_EQ(found[claim.id], wanted->second) << claim.id << ": " << claim.measured;
  }
  EXPECT_EQ(found.size(), expected.size());
  std::vector<std::string> figures;
  for (const LedgerFigure& figure : entry.figures) {
    figures.push_back(figure.id);
    EXPECT_TRUE(std::filesystem::exists(scratch.folder() / figure.data)) << figure.id;
  }
  EXPECT_EQ(figures, experiment.figures);
}

TEST(TextOfChapters1To3, Verdicts) {
  expect_verdicts(text_chapters_1_to_3, {{"abstract-linear-effects", yes},
                                         {"abstract-inconsistency", no},
                                         {"abstract-diagonalisation", holds_if},
                                         {"text-2.1-nonholonomic", yes},
                                         {"text-2.2-precision", holds_if},
                                         {"text-2.2-bounded", yes},
                                         {"text-2.2-correlations", yes},
                                         {"text-2.2.1-optimal", yes},
                                         {"text-A.1-closed-loop", yes},
                                         {"text-A.1-prediction", yes},
                                         {"text-A.2-joseph", yes},
                                         {"text-2.2.3-dependent", yes},
                                         {"text-2.2.3-stationary", yes},
                                         {"text-2.18-depends", yes},
                                         {"text-2.18-only-if", no},
                                         {"text-2.25-birth", misprint},
                                         {"text-3.1-lower-bound", yes},
                                         {"text-3.1-bound-reached", no},
                                         {"text-1-decorrelation", yes},
                                         {"text-3.1-determinants", yes},
                                         {"text-3.1-correlated", yes},
                                         {"text-3.1-two-conditions", yes},
                                         {"text-3.1-unique", yes},
                                         {"text-3.1-uncorrupted", holds_if},
                                         {"text-3.1-known-states", yes},
                                         {"text-3.1-unstable", yes},
                                         {"text-3.2-dynamics", yes},
                                         {"text-3.1-one-pole", yes},
                                         {"text-3.5-constant-error", holds_if},
                                         {"text-3.5-first-look", yes},
                                         {"text-3.3-controllable", yes},
                                         {"text-3.1-map-determinant", holds_if},
                                         {"text-3.1-relative-map", yes},
                                         {"text-3-small-number", holds_if},
                                         {"text-3.3-pseudo-noise", yes},
                                         {"text-3.5-pseudo-noise", yes},
                                         {"text-3.5-remedies", yes},
                                         {"text-3.5-psd-solution", yes}});
}

TEST(Example3_1, Verdicts) {
  expect_verdicts(example_3_1, {{"3.1-eigenvalue-one", yes},
                                {"3.1-steady-covariance", no},
                                {"3.1-steady-gain", no},
                                {"3.1-printed-dynamics", misprint},
                                {"3.1-second-eigenvalue", misprint},
                                {"3.1-marginal", yes},
                                {"3.1-finite-error", yes},
                                {"3.1-initial-conditions", yes},
                                {"3.1-more-landmarks", yes},
                                {"3.1-landmark-gain", yes},
                                {"3.1-landmark-variance", holds_if},
                                {"3.1-consistent", yes}});
}

TEST(Example3_3, Verdicts) {
  expect_verdicts(example_3_3, {{"3.3-observable", yes},
                                {"3.3-gains", misprint},
                                {"3.3-inside", yes},
                                {"3.3-any-noise", yes},
                                {"3.3-limit-inside", no},
                                {"3.3-zero-mean", yes},
                                {"3.3-variance", yes},
                                {"3.3-consistent", yes}});
}

TEST(Example3_4, Verdicts) {
  expect_verdicts(example_3_4, {{"3.4-F", misprint},
                                {"3.4-G", misprint},
                                {"3.4-bearing", misprint},
                                {"3.4-anchor-bearing", misprint},
                                {"3.4-H", yes},
                                {"3.4-product", misprint},
                                {"3.4-frozen-rank", yes},
                                {"3.4-one-anchor", no},
                                {"3.4-two-anchors", yes},
                                {"3.4-no-anchor", yes}});
}

TEST(Example3_6, Verdicts) {
  expect_verdicts(example_3_6, {{"3.6-unbounded", yes},
                                {"3.6-rate", yes},
                                {"3.6-full-rank", no},
                                {"3.6-as-noise", misprint},
                                {"3.6-inflated", yes}});
}

TEST(Example3_8, Verdicts) {
  expect_verdicts(example_3_8, {{"3.8-bounded", yes},
                                {"3.8-one-landmark", yes},
                                {"3.8-variance", yes},
                                {"3.8-gain", yes},
                                {"3.8-controllable", no},
                                {"3.8-inflated", yes},
                                {"3.8-rank-condition", yes},
                                {"3.8-rank-enough", no}});
}

TEST(Example3_10, Verdicts) {
  expect_verdicts(example_3_10, {{"3.10-stable", yes},
                                 {"3.10-gain-everything", yes},
                                 {"3.10-gain-map", no},
                                 {"3.10-start", yes},
                                 {"3.10-variance", yes},
                                 {"3.10-map-alone", yes},
                                 {"3.10-inflated", yes},
                                 {"3.10-pseudo-noise", yes}});
}

}  // namespace
}  // namespace incognita
