// Times and images of live sources, without a camera.
#include <gtest/gtest.h>

#include <thread>

#include "incognita/messages/newest.hpp"
#include "incognita/messages/stream_times.hpp"
#include "incognita/world/live/sized_images.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

TEST(StreamTimes, AreThoseThatTheStreamReports) {
  StreamTimes times;
  EXPECT_EQ(times.time_of(5000.25, 77), 0);
  EXPECT_NEAR(times.time_of(5000.28, 77.05), 0.03, 1e-9) << "it arrived late";
  EXPECT_NEAR(times.time_of(5000.35, 77.10), 0.10, 1e-9);
}

TEST(StreamTimes, FollowTheArrivalWhereNothingPlausibleIsReported) {
  StreamTimes nothing;
  EXPECT_EQ(nothing.time_of(0, 10), 0);
  EXPECT_NEAR(nothing.time_of(0, 10.04), 0.04, 1e-9);
  StreamTimes jumps;
  jumps.time_of(100, 10);
  EXPECT_NEAR(jumps.time_of(50, 10.04), 0.04, 1e-9) << "back, as of another camera";
  EXPECT_NEAR(jumps.time_of(50.03, 10.08), 0.07, 1e-9) << "from there on it is plausible again";
  EXPECT_NEAR(jumps.time_of(9000, 10.12), 0.11, 1e-9) << "far ahead of what has passed";
}

TEST(StreamTimes, KeepTheReportedTimesOfImagesThatANetworkHeldUp) {
  StreamTimes times;
  times.time_of(50, 10);
  EXPECT_NEAR(times.time_of(50.1, 13.0), 0.1, 1e-9) << "three seconds late";
  for (int k = 2; k < 30; ++k) EXPECT_NEAR(times.time_of(50 + 0.1 * k, 13 + 1e-3 * k), 0.1 * k, 1e-9);
}

TEST(StreamTimes, FollowTheArrivalWhereTheClockOfTheStreamIsWrong) {
  StreamTimes slow;
  double t = 0;
  for (int k = 0; k <= 300; ++k) t = slow.time_of(1 + 0.04 * k, 10 + 0.1 * k);
  EXPECT_NEAR(t, 25, 0.2) << "of 30 s";
  StreamTimes fast;
  for (int k = 0; k <= 300; ++k) t = fast.time_of(1 + 0.1 * k, 10 + 0.04 * k);
  EXPECT_NEAR(t, 17, 0.2) << "of 12 s";
}

TEST(StreamTimes, StartAnewWithAnotherConnection) {
  StreamTimes times;
  times.time_of(1, 10);
  times.time_of(1.1, 10.1);
  times.start_anew();
  EXPECT_NEAR(times.time_of(1.2, 15.1), 5.1, 1e-9) << "another clock, which happens to be later";
  EXPECT_NEAR(times.time_of(1.3, 15.25), 5.2, 1e-9);
}

TEST(StreamTimes, AlwaysIncreaseByAMicrosecond) {
  StreamTimes times;
  times.time_of(0, 10);
  EXPECT_EQ(times.time_of(0, 10), 1e-6);
  EXPECT_EQ(times.time_of(0, 9), 2e-6);
  StreamTimes far;
  far.time_of(1, 1e6);
  EXPECT_EQ(far.time_of(1.0333337, 1e6 + 0.03), 0.033334) << "whole microseconds";
}

TEST(Newest, DropsWhatWasNotTaken) {
  Newest<int> newest;
  EXPECT_FALSE(newest.take(0));
  newest.put(1), newest.put(2), newest.put(3);
  EXPECT_EQ(newest.take(0), 3);
  EXPECT_FALSE(newest.take(0.01));
  EXPECT_EQ(newest.dropped(), 2);
}

TEST(Newest, WakesTheOneThatWaits) {
  Newest<int> newest;
  std::thread giver([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    newest.put(7);
  });
  EXPECT_EQ(newest.take(30), 7);
  giver.join();
}

struct OneImage final : LiveSource {
  std::optional<LiveReading> read(double) override {
    return LiveReading{1, std::make_shared<const Image>(64, 48)};
  }
  std::string problem() const override { return ""; }
};

TEST(SizedImages, RefuseAnotherSizeThanThatOfTheCameraModel) {
  const auto source = std::make_shared<OneImage>();
  EXPECT_TRUE(SizedImages(source, 64, 48).read(0));
  try {
    SizedImages(source, 640, 480).read(0);
    ADD_FAILURE() << "not refused";
  } catch (const std::runtime_error& error) {
    EXPECT_HAS(std::string(error.what()),
               "gives images of 64x48 px, and camera.width_px and camera.height_px expect 640x480");
  }
}

}  // namespace
}  // namespace incognita
