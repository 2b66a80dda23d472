// The controller of a robot: when it must stand, and that a command leaves at once.
#include "incognita/app/loop/robot_controller.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita {
namespace {

struct NotedLink final : RobotLink {
  std::vector<Eigen::Vector2d> driven;
  bool stopped = false;
  std::optional<LiveReading> read(double) override { return std::nullopt; }
  void drive(const Eigen::Vector2d& velocity) override { driven.push_back(velocity); }
  void set_stopped(bool stop) override { stopped = stop; }
  bool is_stopped() const override { return stopped; }
  std::string problem() const override { return ""; }
  std::vector<std::string> take_events() override { return {}; }
};

struct FullSpeed final : Controller {
  void state(StateArchive&) override {}
  Command act(const Estimate&, const Goal&, const Observation&, const Tick&) override {
    Command command;
    command.bodies.emplace_back().input = Eigen::Vector2d(0.3, 0.2);
    return command;
  }
};

struct Driven {
  explicit Driven(double recovery_turn_rate_rad_s = 0) : recovery_rad_s(recovery_turn_rate_rad_s) {
    estimate.started = true;
    estimate.bodies.resize(1);
    set(TrackingState::tracking);
    seen.bodies.emplace_back().images.push_back(std::make_shared<Image>(4, 4));
  }
  void set(TrackingState state) { estimate.status.state = estimate.bodies[0].status.state = state; }
  Eigen::Vector2d act(double dt = 0.1) {
    const Command command = controller.act(estimate, goal, seen, {frame++, 0, dt});
    EXPECT_EQ(link->driven.size(), static_cast<std::size_t>(frame));
    EXPECT_EQ(Eigen::Vector2d(command.bodies.front().input), link->driven.back())
        << "what is recorded was sent";
    return link->driven.back();
  }

  double recovery_rad_s;
  std::shared_ptr<NotedLink> link = std::make_shared<NotedLink>();
  std::chrono::steady_clock::time_point now{};
  RobotController controller{std::make_unique<FullSpeed>(),
                             link,
                             {{0.3, 0.3}, 0.5, 1},
                             {.period_s = 0.1, .late_s = 0.3},
                             {.rate_rad_s = recovery_rad_s, .after_s = 1},
                             [this] { return now; }};
  Estimate estimate;
  Observation seen;
  Goal goal;
  std::int64_t frame = 0;
};

TEST(RobotController, AcceleratesWithinItsLimitsAndSendsAtOnce) {
  Driven d;
  EXPECT_TRUE(d.act().isApprox(Eigen::Vector2d(0.05, 0.1)));
  EXPECT_TRUE(d.act().isApprox(Eigen::Vector2d(0.1, 0.2)));
  for (int i = 0; i < 10; ++i) d.act();
  EXPECT_TRUE(d.act().isApprox(Eigen::Vector2d(0.3, 0.2)));
}

TEST(RobotController, StandsAtOnceWhenTheImageIsLateAndAcceleratesAgain) {
  Driven d;
  for (int i = 0; i < 10; ++i) d.act();
  const Observation seen = d.seen;
  d.seen.bodies[0].images.clear();
  EXPECT_TRUE(d.act().isZero());
  d.seen = seen;
  EXPECT_TRUE(d.act().isApprox(Eigen::Vector2d(0.05, 0.1))) << "from rest";
}

TEST(RobotController, AcceleratesFromRestAfterAPauseInWhichTheLinkStoppedTheRobot) {
  Driven d;
  for (int i = 0; i < 10; ++i) d.act();
  d.now += std::chrono::milliseconds(250);
  EXPECT_TRUE(d.act(0.25).isApprox(Eigen::Vector2d(0.3, 0.2))) << "not late: the robot still drives";
  d.now += std::chrono::milliseconds(301);
  EXPECT_TRUE(d.act(0.1).isApprox(Eigen::Vector2d(0.05, 0.1))) << "the time of the images does not count";
}

TEST(RobotController, AGapInTheImagesAllowsNoJump) {
  Driven d;
  EXPECT_TRUE(d.act(60).isApprox(Eigen::Vector2d(0.15, 0.2))) << "at most three periods";
}

TEST(RobotController, StandsWhileItIsLostOrStartingOrStoppedByHand) {
  Driven d;
  d.act();
  d.set(TrackingState::lost);
  EXPECT_TRUE(d.act().isZero());
  d.set(TrackingState::tracking);
  d.estimate.started = false;
  EXPECT_TRUE(d.act().isZero());
  d.estimate.started = true;
  d.link->stopped = true;
  EXPECT_TRUE(d.act().isZero());
  d.link->stopped = false;
  EXPECT_FALSE(d.act().isZero());
}

TEST(RobotController, APersonMayDriveALostRobotButNotABlindOne) {
  Driven d;
  d.set(TrackingState::lost);
  d.goal.bodies.emplace_back().manual = ManualDrive{};
  EXPECT_FALSE(d.act().isZero());
  d.seen.bodies[0].images.clear();
  EXPECT_TRUE(d.act().isZero());
}

TEST(RobotController, ALostRobotStandsAndThenTurnsBackUntilItRecognizesItsMap) {
  Driven d(0.2);
  for (int i = 0; i < 10; ++i) d.act();
  d.set(TrackingState::lost);
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(d.act().isZero()) << "for 1 s";
  for (int i = 0; i < 5; ++i) d.act();
  EXPECT_TRUE(d.act().isApprox(Eigen::Vector2d(0, -0.2))) << "it had turned to the left";
  d.set(TrackingState::relocated);
  EXPECT_GT(d.act().x(), 0);
  d.set(TrackingState::lost);
  EXPECT_TRUE(d.act().isZero()) << "it stands again first";
}

TEST(RobotController, ARecoveryTurnEndsAfterTwoTurnsInVain) {
  Driven d(0.2);
  d.act();
  d.set(TrackingState::lost);
  double turned = 0;
  for (int i = 0; i < 1000; ++i) turned += 0.1 * d.act().y();
  EXPECT_NEAR(turned, -4 * std::numbers::pi, 0.1);
  EXPECT_TRUE(d.act().isZero());
}

TEST(RobotController, ARecoveryTurnObeysStopsAndSpeedLimitsAndWaitsForImages) {
  Driven d(5);
  d.act();
  d.set(TrackingState::lost);
  for (int i = 0; i < 20; ++i) d.act();
  EXPECT_TRUE(d.act().isApprox(Eigen::Vector2d(0, -0.3)));
  d.link->stopped = true;
  EXPECT_TRUE(d.act().isZero());
  d.link->stopped = false;
  d.estimate.started = false;
  EXPECT_TRUE(d.act().isZero());
  d.estimate.started = true;
  d.seen.bodies[0].images.clear();
  EXPECT_TRUE(d.act().isZero());
}

TEST(RobotController, AResumedRobotTurnsTheWayTheOneBeforeWouldHave) {
  Driven before(0.2), resumed(0.2);
  before.act();
  StateWriter writer;
  StateArchive saving(writer);
  before.controller.state(saving);
  const std::string bytes = writer.take();
  StateReader reader(bytes);
  StateArchive restoring(reader);
  resumed.controller.state(restoring);
  EXPECT_EQ(reader.left(), 0u);
  resumed.set(TrackingState::lost);
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(resumed.act().isZero());
  for (int i = 0; i < 5; ++i) resumed.act();
  EXPECT_TRUE(resumed.act().isApprox(Eigen::Vector2d(0, -0.2)));
}

TEST(RobotController, RefusesARecoveryTurnThatIsNone) {
  EXPECT_THROW(Driven(-0.1), std::invalid_argument);
  EXPECT_THROW(Driven{NAN}, std::invalid_argument);
}

}  // namespace
}  // namespace incognita
