// Active SLAM as in the experiments of Chapter 6: deterministic decisions, and less entropy than the
// baselines.
#include <gtest/gtest.h>

#include <algorithm>
#include <future>

#include "experiments/exploring_claims.hpp"
#include "experiments/seeds.hpp"
#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita::exploring {
namespace {

/// Every decision and its scores are equal.
void expect_same(const Run& a, const Run& b) {
  ASSERT_EQ(a.decisions.size(), b.decisions.size());
  for (std::size_t i = 0; i < a.decisions.size(); ++i) {
    EXPECT_EQ(a.decisions[i].action, b.decisions[i].action);
    EXPECT_EQ(a.decisions[i].scores, b.decisions[i].scores) << "not the same bits, decision " << i;
  }
  ASSERT_EQ(a.instants.size(), b.instants.size());
  EXPECT_EQ(a.instants.back().covariance, b.instants.back().covariance);
  EXPECT_EQ(a.instants.back().truth.position, b.instants.back().truth.position);
}

class OnThreads : public ::testing::TestWithParam<const char*> {};

TEST_P(OnThreads, DecisionsAreEqualOnOneAndTwoThreads) {
  const auto once = [] { return explore(GetParam(), {"run.duration_s=5"}, 3); };
  const exploring::Run alone = once();
  ASSERT_GT(alone.decisions.size(), 3u);
  ASSERT_GT(alone.instants.back().landmarks, 0);
  auto beside = std::async(std::launch::async, once);
  const exploring::Run here = once();
  expect_same(alone, here);
  expect_same(alone, beside.get());
}

INSTANTIATE_TEST_SUITE_P(Exploring, OnThreads,
                         ::testing::Values("free-camera", "terrain", "explore-room", "explore-terrain",
                                           "hand-held"),
                         [](const auto& scenario) {
                           std::string name = scenario.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// 95 % interval of the final entropy of `ours` minus that of `theirs`.
Interval gap(const std::string& scenario, const Strategy& ours, const Strategy& theirs, const Sets& sets,
             int seeds) {
  const auto runs = [&](const Strategy& strategy) {
    Sets all = strategy.sets;
    all.insert(all.end(), sets.begin(), sets.end());
    all.push_back("decision.schedule=at-decisions");
    return over_seeds(seeds, [&](std::uint64_t seed) { return explore(scenario, all, seed); });
  };
  return bootstrap_mean(less(each(runs(ours), final_entropy), each(runs(theirs), final_entropy)));
}

TEST(Exploring, MutualInformationLeavesLessEntropyThanRandomMotion) {
  EXPECT_LT(gap("free-camera", by_gaze()[0], baselines()[0], {}, 12).high, 0);
}

TEST(Exploring, MutualInformationLeavesLessEntropyOnImages) {
  EXPECT_LT(gap("explore-room", by_gaze()[0], baselines()[0], {"run.duration_s=15"}, 5).high, 0);
}

TEST(Exploring, CountsReturningLandmarks) {
  const exploring::Run run = explore(
      "hand-held", {"run.duration_s=20", "decision.schedule=at-decisions", "exploration.counted=all"}, 1);
  int returned = 0;
  for (const Decision& d : run.decisions) {
    if (d.t_s < away_s) {
      EXPECT_EQ(d.returned, 0);
    }
    returned += d.returned;
  }
  EXPECT_GT(returned, 0);
}

TEST(Exploring, ARunWithout14LandmarksCountsWithItsEnd) {
  exploring::Run run;
  run.end_s = 35;
  run.located_t_s.assign(13, 2);
  EXPECT_EQ(time_until_the_14th(run), 35);
  run.located_t_s.push_back(7);
  EXPECT_EQ(time_until_the_14th(run), 7);
}

}  // namespace
}  // namespace incognita::exploring
