// The simulated runs of Examples 5.1 to 5.3, their statistics, and the figures and claims of each example.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <set>

#include "experiments/closed_loop_statistics.hpp"
#include "experiments/example_5_1.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/example_5_3.hpp"
#include "experiments/list.hpp"
#include "incognita/control/lqg_regulator.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using namespace closed_loop;
using ClosedLoop = closed_loop::Setup;  // inside a test, Setup is a name of GoogleTest

ClosedLoop short_run() {
  ClosedLoop s = section_5_3::two_circles();
  s.duration_s = 10;
  return s;
}

TEST(ClosedLoopRuns, AreDeterministicForASeed) {
  const auto a = drive(short_run(), 3), b = drive(short_run(), 3), c = drive(short_run(), 4);
  ASSERT_EQ(a.instants.size(), 100u);
  for (std::size_t k = 0; k < a.instants.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(a.instants[k].robots[i].truth, b.instants[k].robots[i].truth);
      EXPECT_EQ(a.instants[k].robots[i].covariance, b.instants[k].robots[i].covariance);
    }
  EXPECT_NE(a.instants.back().robots[0].truth, c.instants.back().robots[0].truth);
}

TEST(ClosedLoopRuns, RespectTheLimitsAndScanEverySecondTick) {
  const auto run = drive(short_run(), 1);
  for (std::size_t k = 0; k < run.instants.size(); ++k) {
    EXPECT_LE(std::abs(run.instants[k].robots[0].input[0]), top_speed_m_s);
    EXPECT_LE(std::abs(run.instants[k].robots[0].input[1]), top_turn_rate);
    if (k % ticks_per_scan == 0 || k == 0) continue;
    for (std::size_t l = 0; l < 16; ++l) {  // without a scan no landmark gains information
      const double before = run.instants[k - 1].traces[l], now = run.instants[k].traces[l];
      EXPECT_TRUE(before == now || std::isnan(before));
    }
  }
}

TEST(ClosedLoopRuns, AnchorsAreNotMappedAndMoreNoiseGivesLargerErrors) {
  ClosedLoop anchored = short_run(), loud = short_run();
  anchored.anchors = 2;
  loud.noise = 5;
  const auto plain = drive(short_run(), 1), known = drive(anchored, 1), noisy = drive(loud, 1);
  EXPECT_EQ(plain.map.size(), known.map.size() + 2);
  const auto rms = [](const closed_loop::Run& run) {
    double sum = 0;
    for (const Instant& i : run.instants) sum += i.robots[0].error().head<2>().squaredNorm();
    return sum;
  };
  EXPECT_GT(rms(noisy), 4 * rms(plain));
}

/// By the plan the inputs do not depend on what happens; by the truth the vehicle goes where it is to go in truth.
TEST(ClosedLoopRuns, AreSteeredByWhatTheyAreToBe) {
  ClosedLoop planned = short_run(), known = short_run();
  planned.steered_by = SteeredBy::plan, known.steered_by = SteeredBy::truth;
  const auto a = drive(planned, 1), b = drive(planned, 2), by_truth = drive(known, 1);
  for (std::size_t k = 0; k < a.instants.size(); ++k)
    EXPECT_EQ(a.instants[k].robots[0].input, b.instants[k].robots[0].input);
  EXPECT_NE(a.instants.back().robots[0].truth, b.instants.back().robots[0].truth);
  known.noise = 20;  // the estimate is far off, and not looked at
  planned.noise = 1e-3;
  const auto off_m = [](const ClosedLoop& setup, const closed_loop::Run& run) {
    return distances_m(run, setup.robots[0].steering.path).back();
  };
  ClosedLoop by_estimate = known;
  by_estimate.steered_by = SteeredBy::estimate;
  EXPECT_LT(off_m(known, by_truth), 0.3);
  EXPECT_LT(off_m(planned, drive(planned, 1)), 0.3);
  EXPECT_LT(off_m(known, drive(known, 1)), off_m(by_estimate, drive(by_estimate, 1)));
}

TEST(ClosedLoopRuns, LandmarksAreClearOfThePaths) {
  const PointLandmarks place = sixteen_landmarks();
  EXPECT_EQ(place.size(), 16u);
  for (const auto& [identity, point] : place) {
    const Eigen::Vector2d p = point;
    EXPECT_GT(std::abs(p.norm() - 7), 1 - 1e-2);
    for (const double x : {-6.0, 6.0}) EXPECT_GT(std::abs((p - Eigen::Vector2d(x, 0)).norm() - 5), 1 - 1e-2);
  }
}

TEST(ClosedLoopStatistics, ShareHasTheIntervalOfPublishedTables) {
  EXPECT_EQ(share_text(5, 10), "5 of 10 (23.7 to 76.3 %)");
  EXPECT_EQ(share_text(0, 10), "0 of 10 (0.0 to 27.8 %)");
  EXPECT_EQ(share_text(10, 10), "10 of 10 (72.2 to 100.0 %)");
  const ClaimNumber half = share_number("half", 5, 10);
  EXPECT_EQ(half.unit, "%");
  EXPECT_NEAR(half.value.low, 23.7, 0.05);
}

TEST(ClosedLoopStatistics, QuantilesInterpolate) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.95), 7);
}

TEST(ClosedLoopStatistics, HeadingModeIsOneAtRestAndLargerWhenReversing) {
  RobotInstant at{{1, 2, 0.4}, {1, 2, 0.4}, Eigen::Matrix3d::Identity(), {0, 0}};
  for (const Eigen::Matrix2d& L : {section_5_1::gain(at.mean), section_5_2::gain(at.mean)}) {
    at.input = {0, 0};
    EXPECT_NEAR(moduli(at, L)[0], 1, 1e-12);
    EXPECT_LT(moduli(at, L)[1], 1);
    at.input = {0.5, 0.3};
    EXPECT_LT(moduli(at, L)[0], 1);
    at.input = {-0.5, 0.3};
    EXPECT_GT(moduli(at, L)[0], 1);
  }
}

TEST(Example51, GainRotatesWithTheBody) {
  const PlanarRegulator regulator({.body = body});
  for (const double heading : {-2.0, 0.3, 3.1}) {
    const planar::Pose<double> pose(1, -4, heading);
    EXPECT_LE((section_5_1::gain(pose) - regulator.act(pose, {10, 10}).L).norm(), 1e-9);
  }
}

TEST(Example52, LawWithoutNoiseConvergesToTheCircle) {
  const section_5_2::Way way = section_5_2::follow(section_5_2::circle, {-7, 0, std::numbers::pi}, 90);
  EXPECT_GT(way.distance_m(section_5_2::circle, 0), 13.9);
  EXPECT_LT(way.distance_m(section_5_2::circle, way.poses.size() - 1), 1e-9);
}

/// A robot that starts at the origin: errors of its start shift and rotate the frame and add to those of its
/// measurements.
TEST(Example53, MinimumTracesExceedThoseOfTheStart) {
  ClosedLoop s = section_5_3::two_circles();
  s.robots.resize(1);
  s.robots[0].start.setZero();
  const std::vector<double> least = section_5_3::least_traces(s);
  for (const auto& [identity, point] : s.place) {
    const double of_start = start_sigmas.head<2>().squaredNorm() +
                            start_sigmas[2] * start_sigmas[2] * Eigen::Vector2d(point).squaredNorm();
    EXPECT_GT(least[static_cast<std::size_t>(identity)], of_start);
    EXPECT_LT(least[static_cast<std::size_t>(identity)], 2 * of_start);
  }
}

TEST(ClosedLoopExamples, DrawTheirFiguresAndNameEachClaimOnce) {
  const testing::Scratch scratch;
  ExperimentSettings few;
  few.out = scratch.folder();
  few.seeds = 6;
  std::set<std::string> names;
  for (const Experiment* example : {&example_5_1, &example_5_2, &example_5_3}) {
    const LedgerEntry entry = example->run(few);
    EXPECT_EQ(entry.id, example->id);
    ASSERT_EQ(entry.figures.size(), example->figures.size());
    for (std::size_t i = 0; i < entry.figures.size(); ++i) {
      EXPECT_EQ(entry.figures[i].id, example->figures[i]);
      EXPECT_TRUE(std::filesystem::exists(scratch / entry.figures[i].data));
    }
    for (const Claim& claim : entry.claims) {
      EXPECT_TRUE(names.insert(claim.id).second) << claim.id;
      EXPECT_TRUE(claim.id.starts_with(entry.id + "-")) << claim.id;
      EXPECT_FALSE(claim.measured.empty() || claim.place.empty() || claim.statement.empty()) << claim.id;
      EXPECT_EQ(claim.measured.find("nan"), std::string::npos) << claim.measured;
    }
  }
}

}  // namespace
}  // namespace incognita
