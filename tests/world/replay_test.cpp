// Range-bearing recordings replayed in the loop, and the simulated drive.
#include "incognita/world/replay/recorded_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/world/points/planar_loop.hpp"

namespace incognita {
namespace {

SharedRangeRecordings shared(std::vector<RangeRecording> recordings) {
  return std::make_shared<const std::vector<RangeRecording>>(std::move(recordings));
}

RangeRecording small() {
  RangeRecording r;
  r.odometry = {{0.9, {1, 0}}, {1.5, {2, 0}}, {2.5, {3, 0}}};
  r.scans = {{1, {{5, 0.1, 3}, {50, 0, 4}}}, {2, {}}, {3, {{6, 0.2, 3}}}};
  r.truth = {{0.8, {0, 0}, 3.0}, {1.2, {4, 0}, -3.0}, {2.9, {8, 8}, 0.0}};
  r.fixes = {{0.8, {0.1, 0}, {}}, {1.9, {3, 0}, {}}};
  return r;
}

TEST(ReplayClock, TicksOncePerScanForItsDuration) {
  ReplayClock clock(scan_times({small()}, 1.5));  // from 0.8, the first event of any kind
  EXPECT_EQ(clock.expected_frames(), 2);
  const Tick first = clock.next(), second = clock.next();
  EXPECT_EQ(first.t, 1);
  EXPECT_EQ(first.dt, 0);
  EXPECT_EQ(second.dt, 1);
  EXPECT_FALSE(clock.next());
}

TEST(RecordedRanges, ReturnsWhatWasMeasuredSinceThePreviousTick) {
  SensorSet sensor = recorded_ranges(shared({small()}), {30, Fixes::all});
  const BodyObservation first = sensor.measure({}, {0, 1, 0}).bodies.at(0),
                        second = sensor.measure({}, {1, 2, 1}).bodies.at(0);
  ASSERT_EQ(first.odometry.size(), 1u);
  ASSERT_EQ(first.landmarks.size(), 1u);  // the other is beyond 30 m
  EXPECT_EQ(first.landmarks[0].identity, 3);
  ASSERT_EQ(first.fixes.size(), 1u);
  EXPECT_EQ(first.fixes[0].position.x(), 0.1);
  ASSERT_EQ(second.odometry.size(), 1u);
  EXPECT_EQ(second.odometry[0].t, 1.5);
  EXPECT_TRUE(second.landmarks.empty());
  ASSERT_EQ(second.fixes.size(), 1u);
  EXPECT_EQ(second.fixes[0].t, 1.9);
}

TEST(RecordedRanges, ReturnsTheRequestedFixesOnly) {
  SensorSet none = recorded_ranges(shared({small()}), {30, Fixes::none}),
            first = recorded_ranges(shared({small()}), {30, Fixes::first});
  EXPECT_TRUE(none.measure({}, {0, 1, 0}).bodies.at(0).fixes.empty());
  EXPECT_FALSE(first.measure({}, {0, 1, 0}).bodies.at(0).fixes.empty());
  EXPECT_TRUE(first.measure({}, {1, 2, 1}).bodies.at(0).fixes.empty());
}

TEST(TruePosition, InterpolatesAndTurnsTheShorterWay) {
  const RangeRecording recording = small();
  const auto reference = true_position(recording, 1.0);
  ASSERT_TRUE(reference);
  EXPECT_NEAR(reference->position.x(), 2, 1e-12);
  EXPECT_NEAR(std::abs(*reference->heading_rad), M_PI, 1e-9);
  EXPECT_FALSE(true_position(recording, 2.0));  // a gap of 1.7 s
  EXPECT_FALSE(true_position(recording, 0.5));
  EXPECT_FALSE(true_position(recording, 3.5));
}

TEST(ReplayWorld, ReportsWhetherTheOrientationIsKnown) {
  RangeRecording r = small();
  for (auto& place : r.truth) place.heading_rad.reset();
  ReplayWorld blind(recorded_truths(shared({r}))), seeing(recorded_truths(shared({small()})));
  EXPECT_FALSE(blind.move({}, {0, 1, 0})->bodies[0].orientation_known);
  EXPECT_TRUE(seeing.move({}, {0, 1, 0})->bodies[0].orientation_known);
  EXPECT_FALSE(seeing.move({}, {1, 2, 1}));
}

TEST(PlanarLoop, IsDeterministicForASeed) {
  PlanarLoopSettings settings;
  settings.duration_s = 20;
  const RangeRecording a = drive_planar_loop(settings, 7), b = drive_planar_loop(settings, 7),
                       c = drive_planar_loop(settings, 8);
  ASSERT_EQ(a.scans.size(), 21u);
  EXPECT_EQ(a.truth.back().position, b.truth.back().position);
  EXPECT_NE(a.truth.back().position, c.truth.back().position);
}

/// The noise stated to the filter is the noise of the data.
TEST(PlanarLoop, HasTheStatedNoise) {
  PlanarLoopSettings settings;
  settings.duration_s = 2000;
  const RangeRecording r = drive_planar_loop(settings, 3);
  double range = 0, bearing = 0, speed = 0, turn = 0;
  int measurements = 0, steps = 0;
  for (const auto& scan : r.scans) {
    const auto truth = true_position(r, scan.t);
    const Eigen::Vector3d pose(truth->position.x(), truth->position.y(), *truth->heading_rad);
    for (const Detection& d : scan.detections) {
      const Eigen::Vector2d z =
          RangeBearing::h<double>(pose, r.landmarks[static_cast<std::size_t>(d.identity)].position);
      EXPECT_LE(z[0], settings.max_range_m);
      range += std::pow(d.range_m - z[0], 2);
      bearing += std::pow(wrap_angle(d.bearing_rad - z[1]), 2);
      ++measurements;
    }
  }
  for (std::size_t k = 0; k + 1 < r.truth.size(); ++k, ++steps) {
    const double dt = r.truth[k + 1].t - r.truth[k].t;
    const Eigen::Vector2d moved = r.truth[k + 1].position - r.truth[k].position;
    const double heading = *r.truth[k].heading_rad;
    const double v = (moved.x() * std::cos(heading) + moved.y() * std::sin(heading)) / dt;
    speed += std::pow(v - r.odometry[k].input[0], 2);
    turn += std::pow(wrap_angle(*r.truth[k + 1].heading_rad - heading) / dt - r.odometry[k].input[1], 2);
  }
  EXPECT_NEAR(std::sqrt(range / measurements), settings.sigma_range_m, 0.05 * settings.sigma_range_m);
  EXPECT_NEAR(std::sqrt(bearing / measurements), settings.sigma_bearing_rad,
              0.05 * settings.sigma_bearing_rad);
  EXPECT_NEAR(std::sqrt(speed / steps), settings.sigma_speed_m_s, 0.05 * settings.sigma_speed_m_s);
  EXPECT_NEAR(std::sqrt(turn / steps), settings.sigma_turn_rate_rad_s, 0.05 * settings.sigma_turn_rate_rad_s);
}

TEST(ReplayWorld, EachRobotHasItsOwnTruth) {
  RangeRecording first = small(), second = small();
  second.truth = {{1.0, {7, 1}, 0.5}, {1.4, {7, 2}, 0.5}};
  ReplayWorld world(recorded_truths(shared({first, second})));
  const auto both = world.move({}, {0, 1.2, 0}), second_only = world.move({}, {1, 1.3, 0.1}),
             neither = world.move({}, {2, 2, 0.7});
  ASSERT_TRUE(both && second_only);
  ASSERT_EQ(both->bodies.size(), 2u);
  ASSERT_TRUE(both->bodies[0].pose && both->bodies[1].pose);
  EXPECT_EQ(both->bodies[0].pose->position, Eigen::Vector3d(4, 0, 0));
  EXPECT_FALSE(second_only->bodies[0].pose);  // its neighbors are 1.7 s apart
  ASSERT_TRUE(second_only->bodies[1].pose);
  EXPECT_NEAR(second_only->bodies[1].pose->position.y(), 1.75, 1e-12);
  EXPECT_FALSE(neither);
}

}  // namespace
}  // namespace incognita
