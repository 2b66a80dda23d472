// A drive command holds as long as its viewer renews it; time is a number here.
#include "incognita/live/drive_watchdog.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

using std::chrono::milliseconds;
using Bodies = std::vector<std::size_t>;

constexpr std::uint64_t anna = 7, ben = 8;
constexpr milliseconds holds{500};

DriveWatchdog::Time at(int ms) { return DriveWatchdog::Time{} + std::chrono::hours(1) + milliseconds(ms); }

DriveBody drive(std::size_t body, double forward) { return {body, {forward, 0, 0}, 0}; }

/// Commands as a channel passes them on.
struct Driven {
  DriveWatchdog watchdog{holds};

  /// Whether it is a command and no renewal.
  bool command(std::uint64_t viewer, const Intervention& intervention, int ms) {
    if (watchdog.renews(viewer, intervention, at(ms))) return false;
    watchdog.accept(viewer, intervention, at(ms));
    return true;
  }
  /// Bodies that are stopped then.
  Bodies stopped(int ms) {
    const Bodies bodies = watchdog.overdue(at(ms));
    for (const std::size_t body : bodies) watchdog.stopped(body);
    return bodies;
  }
};

TEST(DriveWatchdog, StopsABodyOnceWhenItsDriverIsSilent) {
  Driven driven;
  EXPECT_FALSE(driven.watchdog.next());
  EXPECT_TRUE(driven.command(anna, drive(0, 1), 0));
  EXPECT_EQ(driven.watchdog.next(), at(500));
  EXPECT_EQ(driven.stopped(499), Bodies{});
  EXPECT_EQ(driven.stopped(500), Bodies{0});
  EXPECT_EQ(driven.stopped(2000), Bodies{});
  EXPECT_FALSE(driven.watchdog.next());
}

TEST(DriveWatchdog, ARenewalHoldsAndIsNoCommand) {
  Driven driven;
  driven.command(anna, drive(0, 1), 0);
  for (int ms = 150; ms <= 3000; ms += 150) {
    EXPECT_EQ(driven.stopped(ms), Bodies{});
    EXPECT_FALSE(driven.command(anna, drive(0, 1), ms));
  }
  EXPECT_TRUE(driven.command(anna, drive(0, 0.5), 3100)) << "a change is a command";
  EXPECT_EQ(driven.stopped(3599), Bodies{});
  EXPECT_EQ(driven.stopped(3600), Bodies{0});
  EXPECT_TRUE(driven.command(anna, drive(0, 0.5), 3700)) << "the body stands: it is driven anew";
}

TEST(DriveWatchdog, ABodyAtRestNeedsNoDriver) {
  Driven driven;
  driven.command(anna, TakeOverBody{0}, 0);
  driven.command(anna, drive(0, 1), 0);
  EXPECT_TRUE(driven.command(anna, drive(0, 0), 100));
  EXPECT_TRUE(driven.command(anna, drive(0, 0), 200)) << "a wish to stop is never a repetition";
  driven.command(anna, DriveBody{1, {0, 0, 0}, 0.5}, 200);
  EXPECT_TRUE(driven.command(anna, GiveBackBody{1}, 300));
  EXPECT_FALSE(driven.watchdog.next());
  EXPECT_EQ(driven.stopped(5000), Bodies{});
}

TEST(DriveWatchdog, EachBodyHasItsOwnTime) {
  Driven driven;
  driven.command(anna, drive(0, 1), 0);
  driven.command(anna, drive(1, 1), 100);
  driven.command(ben, drive(2, 1), 200);
  driven.command(anna, drive(0, 1), 300);
  EXPECT_EQ(driven.stopped(600), Bodies{1});
  EXPECT_EQ(driven.stopped(700), Bodies{2});
  EXPECT_EQ(driven.stopped(800), Bodies{0});
}

/// The last command counts, although the one before is still repeated.
TEST(DriveWatchdog, ARepetitionDoesNotTakeABodyFromAnotherViewer) {
  for (const Intervention& other : {Intervention{drive(0, -1)}, Intervention{drive(0, 0)},
                                    Intervention{GiveBackBody{0}}, Intervention{TakeOverBody{0}}}) {
    Driven driven;
    driven.command(anna, drive(0, 1), 0);
    driven.command(anna, drive(1, 1), 0);
    EXPECT_TRUE(driven.command(ben, other, 100));
    EXPECT_FALSE(driven.command(anna, drive(0, 1), 200));
    EXPECT_FALSE(driven.command(anna, drive(0, 1), 600));
    const bool moves =
        std::holds_alternative<DriveBody>(other) && std::get<DriveBody>(other).direction.x() != 0;
    EXPECT_EQ(driven.stopped(600), (moves ? Bodies{1, 0} : Bodies{1})) << "not what was overridden";
    EXPECT_FALSE(driven.command(anna, drive(0, 1), 700)) << "still the same held key";
    EXPECT_TRUE(driven.command(anna, drive(0, 0.5), 800));
    EXPECT_EQ(driven.stopped(1300), Bodies{0});
  }
}

TEST(DriveWatchdog, WhatIsOverriddenAndNoLongerRepeatedIsForgotten) {
  Driven driven;
  driven.command(anna, drive(0, 1), 0);
  driven.command(ben, drive(0, 0), 100);
  EXPECT_EQ(driven.stopped(500), Bodies{});
  EXPECT_TRUE(driven.command(anna, drive(0, 1), 600));
}

TEST(DriveWatchdog, WhoLeavesDrivesNoLonger) {
  Driven driven;
  driven.command(anna, drive(0, 1), 0);
  driven.command(ben, drive(1, 1), 0);
  driven.watchdog.leave(anna);
  EXPECT_EQ(driven.stopped(10), Bodies{0});
  EXPECT_EQ(driven.watchdog.next(), at(500));
  driven.watchdog.clear();
  EXPECT_EQ(driven.stopped(1000), Bodies{});
}

TEST(DriveWatchdog, ABodyThatCouldNotBeStoppedStaysOverdue) {
  Driven driven;
  driven.command(anna, drive(0, 1), 0);
  EXPECT_EQ(driven.watchdog.overdue(at(500)), Bodies{0});
  EXPECT_EQ(driven.watchdog.overdue(at(520)), Bodies{0});
  EXPECT_FALSE(driven.command(anna, drive(0, 1), 530)) << "it still moves, and its driver is there again";
  EXPECT_EQ(driven.stopped(540), Bodies{});
}

}  // namespace
}  // namespace incognita
