// Example 5.4: its runs, their summaries, and the findings that do not depend on random draws.
#include "experiments/example_5_4.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "experiments/seeds.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita::swinging_camera {
namespace {

using CameraSetup = Setup;  // inside a test, Setup is a name of GoogleTest

CameraSetup brief() {
  CameraSetup setup;
  setup.duration_s = 6;
  return setup;
}

TEST(OverSeeds, KeepsTheOrderAndRethrowsErrors) {
  const auto squares = over_seeds(100, [](std::uint64_t seed) { return seed * seed; });
  ASSERT_EQ(squares.size(), 100u);
  for (std::uint64_t i = 0; i < 100; ++i) EXPECT_EQ(squares[i], (i + 1) * (i + 1));
  EXPECT_THROW(over_seeds(10,
                          [](std::uint64_t seed) {
                            if (seed == 7) throw std::runtime_error("seven");
                            return seed;
                          }),
               std::runtime_error);
}

TEST(SwingingCamera, IsDeterministicOnAnyNumberOfThreads) {
  const Summary alone = summary(run(brief(), 3));
  const auto among = runs(brief(), 4);
  EXPECT_EQ(among[2].rms_error_m, alone.rms_error_m);
  EXPECT_EQ(among[2].pose_nees, alone.pose_nees);
  EXPECT_NE(among[1].rms_error_m, alone.rms_error_m);
}

TEST(SwingingCamera, HasTheSameLandmarksForAnySetup) {
  CameraSetup other = brief();
  other.anchors = 6, other.given_commands = false, other.steered_by_truth = true;
  const Course a = run(brief(), 5), b = run(other, 5);
  EXPECT_EQ(a.place, b.place);
  EXPECT_EQ(a.instants[0].truth, b.instants[0].truth);
  for (const Eigen::Vector3d& p : a.place) {
    EXPECT_LE(std::abs(p.x()), 4);
    EXPECT_LE(std::abs(p.y()), 3);
    EXPECT_LE(std::abs(p.z()), 1);
  }
  EXPECT_EQ(b.map.size(), run(other, 5).map.size());
  for (const MappedPoint& p : b.map)  // anchors are known, not mapped
    for (int anchor = 0; anchor < 6; ++anchor) EXPECT_NE(p.truth, b.place[static_cast<std::size_t>(anchor)]);
}

TEST(SwingingCamera, FollowsItsPathInTheEstimatedFrame) {
  const CameraSetup setup = brief();
  const auto states = steered(setup, 0, 1);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Reference reference = at(setup.path, static_cast<double>(k) / setup.rate_hz);
    EXPECT_LT((states[k].head<3>() - reference.position).norm(), 0.02);
    EXPECT_LT(gaze_off_rad(states[k], reference), 0.05);
  }
}

/// True motion on a circle of half the estimated size, with an error of 0.1 m in z and a sigma of 0.04.
Course synthetic() {
  Course course;
  for (int k = 0; k < 200; ++k) {
    Instant i;
    i.t = k / 20.0;
    i.truth.setZero(), i.mean.setZero();
    i.truth.head<3>() << std::cos(i.t), std::sin(i.t), 0.1;
    i.mean.head<3>() << 2 * std::cos(i.t), 2 * std::sin(i.t), 0;
    i.truth.segment<4>(3) = i.mean.segment<4>(3) = level_gaze(0);
    i.error << 0, 0, 0.1, 0, 0, 0;
    i.sigma << 0.1, 0.1, 0.04, 0.01, 0.01, 0.01;
    i.command << 3, 0, 0, 0, 0, k % 2 ? 1 : 0;
    i.pose_nees = 2, i.nis = k % 2 ? 1 : 0;
    course.instants.push_back(i);
  }
  course.map = {{{1, 0, 0}, {1, 0, 0.2}, Eigen::Matrix3d::Identity()}};
  return course;
}

TEST(Summary, HasTheValuesOfTheCourse) {
  const Summary s = summary(synthetic());
  EXPECT_NEAR(s.rms_error_m, 0.1, 1e-12);
  EXPECT_NEAR(s.scale_off, -0.5, 1e-9);
  EXPECT_EQ(s.inside[0], 1);
  EXPECT_EQ(s.inside[2], 0);
  EXPECT_NEAR(s.truly_off_m, std::sqrt(1.01), 1e-9);
  EXPECT_NEAR(s.estimated_off_m, 2, 1e-9);
  EXPECT_EQ(s.at_limit, 1);
  EXPECT_EQ(s.most_rad_s2, 1);
  EXPECT_EQ(s.pose_nees, 2);
  EXPECT_EQ(s.nis, 1);
  EXPECT_EQ(s.mapped, 1);
  EXPECT_EQ(s.error_m.size(), 10u);
  EXPECT_EQ(follows({s}), Answer::refuted);
}

using Findings = std::map<std::string, std::string>;
Findings findings(const std::vector<Claim>& claims) {
  Findings found;
  for (const Claim& claim : claims) {
    EXPECT_TRUE(found.emplace(claim.id, name(claim.finding)).second) << claim.id << " occurs twice";
    EXPECT_EQ(claim.why.empty(), claim.finding == Finding::holds) << claim.id;
  }
  return found;
}

TEST(Example5_4, FindingsOnItsEquations) {
  ExperimentSettings settings;
  settings.seeds = 200;
  EXPECT_EQ(findings(model_claims()), (Findings{{"5.4-sampled", "holds-if"},
                                                {"5.4-quaternion", "misprint"},
                                                {"5.4-norm", "holds"},
                                                {"5.4-lens", "holds-if"},
                                                {"5.4-linear", "misprint"}}));
  EXPECT_EQ(findings(law_claims(settings)), (Findings{{"5.4-amplitude", "does-not-hold"},
                                                      {"5.4-returns", "does-not-hold"},
                                                      {"5.4-derivative", "holds"},
                                                      {"5.4-velocity", "misprint"},
                                                      {"5.4-orientation", "does-not-hold"},
                                                      {"5.4-regulates", "holds"},
                                                      {"5.4-asymptotic", "holds-if"},
                                                      {"5.4-psd", "holds-if"}}));
}

}  // namespace
}  // namespace incognita::swinging_camera
