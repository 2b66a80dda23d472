// A camera or robot as clock and sensors of the loop, by a source and a clock that the test moves.
#include "incognita/world/live/live_feed.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "incognita/math/saved_state/state_archive.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;

/// Readings arrive at given times of a clock that goes on only while somebody waits.
struct ScriptedSource final : LiveSource {
  double now_s = 100;
  std::deque<std::pair<double, LiveReading>> arrivals;  ///< when, what
  std::string why;
  bool ended = false;

  void add(double arrives_s, double t, std::vector<Odometry> odometry = {}) {
    arrivals.push_back({arrives_s, {t, std::make_shared<Image>(4, 4), std::move(odometry)}});
  }
  std::optional<LiveReading> read(double wait_s) override {
    if (!arrivals.empty() && arrivals.front().first <= now_s + wait_s) {
      now_s = std::max(now_s, arrivals.front().first);
      LiveReading reading = std::move(arrivals.front().second);
      arrivals.pop_front();
      return reading;
    }
    now_s += wait_s + 1e-3;
    return std::nullopt;
  }
  bool has_ended() const override { return ended; }
  std::string problem() const override { return why; }
  std::vector<std::string> take_events() override { return {}; }
};

struct Feed {
  explicit Feed(
      LiveFeedSettings settings = {.duration_s = 1000, .period_s = 0.1, .late_s = 0.3, .give_up_s = 20})
      : feed(settings, source, [this] { return source->now_s; }) {
    feed.report_to([this](const std::string& line) { said += line + "\n"; });
  }
  std::shared_ptr<ScriptedSource> source = std::make_shared<ScriptedSource>();
  LiveFeed feed;
  std::string said;
};

bool has_image(const LiveFeed& feed) { return image_of(feed.observation()) != nullptr; }

TEST(LiveFeed, ItsTicksAreTheStampsOfTheImages) {
  Feed f;
  f.source->add(105, 5000.1);
  f.source->add(105.1, 5000.2);
  const Tick first = f.feed.next();
  EXPECT_EQ(first.frame, 0);
  EXPECT_EQ(first.t, 5000.1);
  EXPECT_EQ(first.dt, 0);
  EXPECT_TRUE(has_image(f.feed));
  const Tick second = f.feed.next();
  EXPECT_EQ(second.t, 5000.2);
  EXPECT_EQ(second.dt, 0.1) << "stamps are in whole microseconds";
}

TEST(LiveFeed, GoesOnWithoutImagesWhileTheyAreLateAndUsesThemAgain) {
  Feed f;
  f.source->add(100, 50);
  f.source->add(103, 53);
  f.source->add(103.1, 53.1);
  EXPECT_EQ(f.feed.next().t, 50);
  double last_t = 50;
  int blind = 0;
  for (Tick tick = f.feed.next(); !has_image(f.feed); tick = f.feed.next()) {
    EXPECT_GE(f.source->now_s, 100.3) << "not before it is late";
    EXPECT_GT(tick.t, last_t);
    EXPECT_LT(tick.t, 53) << "the image that comes next must not be older";
    last_t = tick.t;
    ASSERT_LT(++blind, 40);
  }
  EXPECT_GT(blind, 15);
  EXPECT_HAS(f.said, "no image for 0.3 s");
  EXPECT_HAS(f.said, "images come again, after 3.0 s");
  EXPECT_EQ(f.feed.next().t, 53.1);
}

TEST(LiveFeed, GivesOdometrySinceTheLastTickInTheOrderOfItsStamps) {
  Feed f;
  f.source->add(100, 50, {{49.9, {9, 0}}});
  f.source->add(100.1, 50.1, {{50.12, {3, 0}}, {50.09, {2, 0}}, {50.05, {1, 0}}, {49.95, {9, 0}}});
  f.source->add(100.2, 50.2, {});
  f.feed.next();
  f.feed.next();
  const auto second = f.feed.observation().odometry;
  ASSERT_EQ(second.size(), 2u);
  EXPECT_EQ(second[0].input[0], 1);
  EXPECT_EQ(second[1].input[0], 2);
  f.feed.next();
  ASSERT_EQ(f.feed.observation().odometry.size(), 1u) << "one that was early";
  EXPECT_EQ(f.feed.observation().odometry[0].input[0], 3);
}

TEST(LiveFeed, ImagesWhoseStampsGoBackAreNotUsedAndThatIsSaid) {
  Feed f;
  f.source->add(100, 50);
  f.source->add(100.1, 20);
  f.source->add(100.2, 50);
  f.source->add(100.25, 50.25);
  EXPECT_EQ(f.feed.next().t, 50);
  EXPECT_EQ(f.feed.next().t, 50.25);
  EXPECT_HAS(f.said, "went back by 30.0 s");
  EXPECT_EQ(f.feed.counts().back().second, 2);
}

TEST(LiveFeed, FailsWhenNoImageComesAndSaysWhy) {
  Feed f;
  f.source->why = "no connection to ws://x: refused";
  EXPECT_HAS(message_of<std::runtime_error>([&] { f.feed.next(); }),
             "for 20.0 s: no connection to ws://x: refused");
  Feed connected;
  EXPECT_HAS(message_of<std::runtime_error>([&] { connected.feed.next(); }), "no image for 20");
  Feed later;
  later.source->add(100, 50);
  EXPECT_HAS(message_of<std::runtime_error>([&] {
               for (int i = 0; i < 1000; ++i) later.feed.next();
             }),
             "no image for 20");
}

TEST(LiveFeed, EndsAfterItsDurationAndWhenTheRunIsOver) {
  Feed f({.duration_s = 0.25, .period_s = 0.1, .late_s = 0.3, .give_up_s = 20});
  for (int i = 0; i < 10; ++i) f.source->add(100 + 0.1 * i, 50 + 0.1 * i);
  int frames = 0;
  while (f.feed.next()) ++frames;
  EXPECT_EQ(frames, 3);
  Feed rare({.duration_s = 0.25, .period_s = 0.1, .give_up_s = 20});
  for (const double t : {50.0, 50.1, 50.3}) rare.source->add(t + 50, t);
  EXPECT_TRUE(rare.feed.next());
  EXPECT_TRUE(rare.feed.next());
  EXPECT_FALSE(rare.feed.next()) << "an image from after the duration is not used, as in a replay";
  Feed over;
  over.feed.end_when([] { return true; });
  EXPECT_FALSE(over.feed.next());
}

/// As of a camera in a hand: a replay of its images has no ticks without.
TEST(LiveFeed, WaitsForImagesWhereNoneIsLate) {
  Feed f({.duration_s = 1000, .period_s = 0.1, .give_up_s = 20});
  f.source->add(100, 50);
  f.source->add(110, 60);
  EXPECT_EQ(f.feed.next().t, 50);
  const Tick second = f.feed.next();
  EXPECT_EQ(second.t, 60);
  EXPECT_EQ(second.frame, 1);
  EXPECT_TRUE(has_image(f.feed));
}

TEST(LiveFeed, EndsWithItsSource) {
  Feed f;
  f.source->add(100, 50);
  f.source->ended = true;
  EXPECT_TRUE(f.feed.next()) << "an image that waits is used";
  EXPECT_FALSE(f.feed.next());
}

std::string saved(LiveFeed& feed) {
  StateWriter writer;
  StateArchive archive(writer);
  feed.state(archive);
  return std::string(writer.bytes());
}

void restore(LiveFeed& feed, const std::string& bytes) {
  StateReader reader(bytes);
  StateArchive archive(reader);
  feed.state(archive);
}

/// The clock of a camera begins at 0 again, that of a robot has gone on meanwhile.
TEST(LiveFeed, GoesOnAfterASavedRun) {
  for (const double again : {0.0, 49.0, 58.0}) {
    Feed f;
    f.source->add(100, 50);
    f.source->add(100.1, 50.1);
    f.feed.next(), f.feed.next();
    Feed resumed;
    restore(resumed.feed, saved(f.feed));
    resumed.source->add(100, again, {{again - 0.05, {1, 0}}});
    resumed.source->add(100.1, again + 0.1);
    const Tick tick = resumed.feed.next();
    EXPECT_EQ(tick.frame, 2);
    EXPECT_DOUBLE_EQ(tick.t, again > 50 ? again : 50.2) << "the stamps of a robot stay";
    EXPECT_NEAR(tick.dt, 0.1, 1e-9) << "the time between the runs does not count";
    EXPECT_EQ(resumed.feed.observation().odometry.size(), 1u) << "its stamps are moved, too";
    EXPECT_NEAR(resumed.feed.next().dt, 0.1, 1e-9);
  }
}

TEST(LiveFeed, CountsNoTimeBetweenTwoRunsAsDuration) {
  const LiveFeedSettings short_one{.duration_s = 0.4, .period_s = 0.1, .give_up_s = 20};
  Feed f(short_one), resumed(short_one);
  f.source->add(100, 50);
  f.source->add(100.1, 50.1);
  f.feed.next(), f.feed.next();
  restore(resumed.feed, saved(f.feed));
  for (int i = 0; i < 9; ++i) resumed.source->add(100 + 0.1 * i, 77 + 0.1 * i);
  int frames = 0;
  while (resumed.feed.next()) ++frames;
  EXPECT_EQ(frames, 2);
}

TEST(LiveFeed, RefusesTimesThatDoNotFit) {
  EXPECT_THROW(Feed({.late_s = 0.05}), std::invalid_argument);
  EXPECT_THROW(Feed({.duration_s = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
