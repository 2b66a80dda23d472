// The watchdog: when a robot drives, and why it stands.
#include "incognita/live/robot/watchdog.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace incognita {
namespace {

using Stop = CommandWatchdog::Stop;
const Eigen::Vector2d forward(0.3, 0.1), zero(0, 0);

CommandWatchdog watchdog() { return CommandWatchdog({.timeout_s = 0.5, .stale_s = 0.4}); }

TEST(Watchdog, StandsUntilTheFirstCommand) {
  const CommandWatchdog dog = watchdog();
  EXPECT_EQ(dog.velocity(0), zero);
  EXPECT_EQ(dog.reason(100), Stop::no_command);
}

TEST(Watchdog, StopsAtTheTimeoutAndNotBefore) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  EXPECT_EQ(dog.velocity(10), forward);
  EXPECT_EQ(dog.velocity(10.499), forward);
  EXPECT_EQ(dog.velocity(10.5), zero);
  EXPECT_EQ(dog.reason(10.5), Stop::silence);
  dog.command(forward, 11, 1);
  EXPECT_EQ(dog.velocity(11), forward) << "a fresh command drives it again";
}

TEST(Watchdog, AClockThatJumpsBackStopsIt) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  EXPECT_EQ(dog.velocity(3), zero);
}

TEST(Watchdog, StopsWhenTheCommanderIsDisconnectedAndStaysSo) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  dog.disconnected(2);
  EXPECT_EQ(dog.velocity(10.1), forward) << "another client";
  dog.disconnected(1);
  EXPECT_EQ(dog.velocity(10.1), zero);
  EXPECT_EQ(dog.reason(10.1), Stop::disconnected);
  dog.command(forward, 10.2, 2);
  EXPECT_EQ(dog.velocity(10.2), forward);
}

TEST(Watchdog, AStaleCommandStopsItWhateverCameBefore) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1, 0.1);
  EXPECT_EQ(dog.velocity(10.1), forward);
  dog.command(forward, 10.1, 1, 0.41);
  EXPECT_EQ(dog.velocity(10.1), zero);
  EXPECT_EQ(dog.reason(10.1), Stop::stale);
  dog.command(forward, 10.2, 1, -0.41);
  EXPECT_EQ(dog.reason(10.2), Stop::stale) << "from the future";
  dog.command(forward, 10.2, 1, NAN);
  EXPECT_EQ(dog.reason(10.2), Stop::stale);
  dog.command(forward, 10.3, 1, 0.39);
  EXPECT_EQ(dog.velocity(10.3), forward);
}

TEST(Watchdog, ACommandThatIsNotFiniteStopsIt) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  dog.command({NAN, 0}, 10.1, 1);
  EXPECT_EQ(dog.velocity(10.1), zero);
  EXPECT_EQ(dog.reason(10.1), Stop::invalid);
  dog.command({0, std::numeric_limits<double>::infinity()}, 10.1, 1);
  EXPECT_EQ(dog.velocity(10.1), zero);
}

TEST(Watchdog, StoppedByHandItWaitsForReleaseAndForAFreshCommand) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  dog.stop();
  EXPECT_EQ(dog.velocity(10), zero);
  dog.command(forward, 10.1, 1);
  EXPECT_EQ(dog.reason(10.1), Stop::by_hand);
  dog.disconnected(1);
  EXPECT_EQ(dog.reason(10.1), Stop::by_hand) << "a lost connection releases nothing";
  dog.release();
  EXPECT_EQ(dog.velocity(10.2), zero) << "the command from before the release does not count";
  dog.command(forward, 10.3, 1);
  EXPECT_EQ(dog.velocity(10.3), forward);
}

TEST(Watchdog, AMessageOfTheCommanderThatCannotBeReadStopsIt) {
  CommandWatchdog dog = watchdog();
  dog.unreadable(0);
  EXPECT_EQ(dog.reason(10), Stop::no_command);
  dog.command(forward, 10, 1);
  dog.unreadable(2);
  EXPECT_EQ(dog.velocity(10.1), forward) << "another client";
  dog.unreadable(1);
  EXPECT_EQ(dog.velocity(10.1), zero);
  EXPECT_EQ(dog.reason(10.1), Stop::invalid);
  dog.command(forward, 10.2, 1);
  EXPECT_EQ(dog.velocity(10.2), forward);
  dog.stop();
  dog.unreadable(1);
  EXPECT_EQ(dog.reason(10.3), Stop::by_hand);
}

TEST(Watchdog, ItsEndIsForGood) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  dog.end();
  dog.stop();
  dog.release();
  dog.disconnected(1);
  dog.command(forward, 10.1, 1);
  EXPECT_EQ(dog.velocity(10.1), zero);
  EXPECT_EQ(dog.reason(10.1), Stop::ended);
}

TEST(Watchdog, ReleaseWithoutAStopChangesNothing) {
  CommandWatchdog dog = watchdog();
  dog.command(forward, 10, 1);
  dog.release();
  EXPECT_EQ(dog.velocity(10.1), forward);
}

/// Whatever happens in whatever order, it never drives without a valid command in the last timeout.
TEST(Watchdog, NeverDrivesWithoutAFreshCommand) {
  std::mt19937 random(1);
  CommandWatchdog dog = watchdog();
  double now = 0, fresh = -1e9;
  bool held = false;
  for (int i = 0; i < 100000; ++i) {
    now += std::uniform_real_distribution<>(0, 0.3)(random);
    switch (random() % 6) {
      case 0:
      case 1: {
        const double age = std::uniform_real_distribution<>(0, 0.8)(random);
        dog.command(forward, now, 1, age);
        if (!held) fresh = age <= 0.4 ? now : -1e9;
        break;
      }
      case 2:
        dog.disconnected(1), fresh = -1e9;
        break;
      case 3:
        dog.stop(), held = true, fresh = -1e9;
        break;
      case 4:
        dog.release(), held = false;
        break;
      default:
        break;
    }
    ASSERT_EQ(!dog.velocity(now).isZero(), !held && now - fresh < 0.5) << "step " << i;
  }
}

TEST(Watchdog, RefusesTimesThatAreNotPositive) {
  EXPECT_THROW(CommandWatchdog({.timeout_s = 0}), std::invalid_argument);
  EXPECT_THROW(CommandWatchdog({.timeout_s = 1, .stale_s = NAN}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
