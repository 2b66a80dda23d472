// Every motion model with every sensor and every control law runs, or is refused with the reason.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "tests/app/point_scenario.hpp"

namespace incognita {
namespace {

using namespace testing;

using Names = std::tuple<std::string, std::string, const char*>;

/// The values of sensor.type, the camera with either lens.
std::vector<std::string> sensors_and_lenses() {
  std::vector<std::string> names{"wide-angle", "pinhole", "fisheye"};
  for (const std::string& word : sensor_words())
    if (word != "camera") names.push_back(word);
  return names;
}

class ModelCombination : public ::testing::TestWithParam<Names> {};

TEST_P(ModelCombination, RunsOrIsRefusedWithTheReason) {
  const ModelChoice c{std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())};
  if (!c.can_measure() || !c.can_steer()) {
    const std::string why = complaint(text_of(c));
    EXPECT_NE(why.find(c.can_measure() ? "controller.law = " : "sensor.type = "), std::string::npos) << why;
    EXPECT_GT(why.size(), 60u) << why;
    return;
  }
  const Ran ran = run(load(text_of(c)));
  EXPECT_EQ(ran.ticks, 60);
  EXPECT_EQ(ran.last.status.state, TrackingState::tracking) << ran.last.status.reason;
  ASSERT_EQ(ran.last.bodies.size(), 1u);
  const SnapshotBody& v = ran.last.bodies.front();
  ASSERT_TRUE(v.truth.has_value());
  EXPECT_LT((v.truth->position - v.estimate.position).norm(), 0.5);
  EXPECT_EQ(v.reference.has_value(), c.law != "none");
  EXPECT_TRUE(std::isfinite(ran.last.entropy.total));
  EXPECT_EQ(ran.last.bodies.at(0).decision.actions.empty(), c.law != "active");
}

std::string name_of(const ::testing::TestParamInfo<Names>& info) {
  std::string name =
      std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param) + "_" + std::get<2>(info.param);
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    All, ModelCombination,
    ::testing::Combine(::testing::ValuesIn(motion_names()), ::testing::ValuesIn(sensors_and_lenses()),
                       ::testing::Values("none", "tracking", "lqg", "feedback-linearization", "active")),
    name_of);
}  // namespace
}  // namespace incognita
