// Bodies that a person takes over and gives back.
#include "incognita/decision/taken_over.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

/// Chooses action 1 for both of its bodies.
struct Always : Strategy {
  std::vector<std::string> names{"stay", "left"};
  std::vector<std::size_t> restarted;
  Goal choose(const Estimate&, const Observation&, const Tick&) override {
    Goal goal;
    goal.bodies.resize(2);
    for (BodyGoal& body : goal.bodies) body.scores = {0, 2}, body.chosen = 1, body.decided = true;
    return goal;
  }
  void restart(std::size_t body) override { restarted.push_back(body); }
  const std::vector<std::string>& actions(std::size_t) const override { return names; }
};

TEST(TakenOver, OnlyTheBodyThatIsTakenOverIsDriven) {
  TakenOver strategy(std::make_unique<Always>());
  strategy.take_over(1);
  strategy.drive({1, {0.5, 0, -1}, 0.25});
  const Goal goal = strategy.choose({}, {}, {});
  EXPECT_EQ(goal.bodies[0].chosen, 1);
  EXPECT_FALSE(goal.bodies[0].manual);
  EXPECT_EQ(goal.bodies[1].chosen, -1);
  EXPECT_FALSE(goal.bodies[1].decided);
  EXPECT_EQ(goal.bodies[1].scores, (std::vector<double>{0, 2}));
  ASSERT_TRUE(goal.bodies[1].manual);
  EXPECT_EQ(goal.bodies[1].manual->direction, Eigen::Vector3d(0.5, 0, -1));
  EXPECT_EQ(goal.bodies[1].manual->turn, 0.25);
}

TEST(TakenOver, ABodyIsStillUntilItIsDriven) {
  TakenOver strategy(std::make_unique<Always>());
  strategy.take_over(0);
  EXPECT_TRUE(strategy.choose({}, {}, {}).bodies[0].manual->direction.isZero());
}

TEST(TakenOver, TheStrategyChoosesAnewAfterwards) {
  auto always = std::make_unique<Always>();
  Always& inner = *always;
  TakenOver strategy(std::move(always));
  strategy.give_back(0);  // was not taken over
  strategy.take_over(0);
  strategy.give_back(0);
  EXPECT_EQ(inner.restarted, std::vector<std::size_t>{0});
  EXPECT_EQ(strategy.choose({}, {}, {}).bodies[0].chosen, 1);
}

TEST(TakenOver, RefusesToDriveOthersAndBeyondTheLimits) {
  TakenOver strategy(std::make_unique<Always>());
  EXPECT_THROW(strategy.drive({0, {0, 0, 0}, 0}), std::invalid_argument);
  strategy.take_over(0);
  EXPECT_THROW(strategy.drive({0, {1.1, 0, 0}, 0}), std::invalid_argument);
  EXPECT_THROW(strategy.drive({0, {0, 0, 0}, -1.1}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
