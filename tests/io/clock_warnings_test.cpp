#include "incognita/io/recordings/clock_warnings.hpp"

#include <gtest/gtest.h>

#include "incognita/world/points/planar_loop.hpp"

namespace incognita {
namespace {

RangeRecording drive() { return drive_planar_loop({.duration_s = 60}, 5); }

TEST(ClockWarnings, NoneForADriveWithASingleClock) {
  EXPECT_TRUE(clock_warnings(drive()).empty());
  EXPECT_TRUE(clock_warnings({}).empty());
}

TEST(ClockWarnings, OdometryInMillisecondsAndScansInSeconds) {
  RangeRecording recording = drive();
  for (Odometry& odometry : recording.odometry) odometry.t *= 1000;
  const auto warnings = clock_warnings(recording);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(
      warnings[0].find("the odometry (0 s to 60000 s) and the scans (0 s to 60 s) overlap by only 0.1 %"),
      std::string::npos)
      << warnings[0];
  EXPECT_NE(warnings[1].find("the odometry reading of 0 s is held for 60 s"), std::string::npos)
      << warnings[1];
  EXPECT_NE(warnings[1].find("1 s between scans"), std::string::npos);
}

TEST(ClockWarnings, ScansInMilliseconds) {
  RangeRecording recording = drive();
  for (auto& scan : recording.scans) scan.t *= 1000;
  EXPECT_EQ(clock_warnings(recording).size(), 2u);
}

TEST(ClockWarnings, OdometryWithAGap) {
  RangeRecording recording = drive();
  recording.odometry.erase(recording.odometry.begin() + 200, recording.odometry.begin() + 350);
  const auto warnings = clock_warnings(recording);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("is held for 15.1 s; the median interval is 0.1 s"), std::string::npos)
      << warnings[0];
}

}  // namespace
}  // namespace incognita
