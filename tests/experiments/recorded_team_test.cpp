// A synthetic recording of two robots: the joint and the separate filters are evaluated at the same times and
// differ in their measurements.
#include "experiments/recorded_team.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "experiments/list.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "tests/scratch.hpp"

namespace incognita::recorded_team {
namespace {

const std::vector<Eigen::Vector2d> places = {{0, 4}, {3, -1}, {-2, -2}};

/// Drives to the left at 0.3 m/s, with odometry at 20 Hz; measures landmarks until `measurements_until_s`,
/// and the other robot always.
RangeRecording robot(const planar::Pose<double>& start, double first_measurement_s,
                     double measurements_until_s, const std::vector<planar::Pose<double>>& other,
                     std::vector<planar::Pose<double>>& poses) {
  RangeRecording r;
  r.vehicle = "differential-drive";
  planar::Pose<double> pose = start;
  const Eigen::Vector2d input(0.3, 0.2);
  constexpr double dt = 0.05;
  for (int k = 0; k < 800; ++k) {
    const double t = k * dt;
    r.odometry.push_back({t, input});
    r.truth.push_back({t, pose.head<2>(), pose[2]});
    poses.push_back(pose);
    if (k % 10 == 0 && t >= first_measurement_s) {
      RangeRecording::Scan scan{t + first_measurement_s * 0.01, {}};
      if (t < measurements_until_s)
        for (std::size_t i = 0; i < places.size(); ++i) {
          const auto prediction = RangeBearing::predict_measurement(pose, places[i]);
          scan.detections.push_back({prediction->z[0], prediction->z[1], static_cast<std::int64_t>(i) + 6});
        }
      if (!other.empty()) {
        const auto prediction =
            RangeBearing::predict_measurement(pose, other[static_cast<std::size_t>(k)].head<2>());
        scan.vehicles.push_back({prediction->z[0], prediction->z[1], 0});
      }
      r.scans.push_back(scan);
    }
    pose = DifferentialDrive{}.step(pose, input, dt).x;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    r.landmarks.push_back({static_cast<std::int64_t>(i) + 6, places[i]});
  return r;
}

/// The second robot measures no landmarks after 10 s, and the first robot all the time.
Robots two() {
  std::vector<planar::Pose<double>> first, second;
  const RangeRecording a = robot({1, 0, 0}, 0, 1e9, {}, first);
  const RangeRecording b = robot({-1, 1, 1}, 0.5, 10, first, second);
  return {a, b};
}

TEST(RecordedTeam, IsEvaluatedAtTheSameTimesJointlyAndSeparately) {
  const Robots robots = two();
  const Drive joint = together(robots, {});
  for (std::size_t i = 0; i < 2; ++i) {
    const Drive by_itself = alone(robots, i, {});
    ASSERT_EQ(by_itself.robots.size(), 1u);
    EXPECT_EQ(by_itself.robots[0].t_s, joint.robots[i].t_s);
    EXPECT_LT(by_itself.measurements, joint.measurements);
  }
}

TEST(RecordedTeam, JointFilterIsMoreAccurate) {
  const Robots robots = two();
  const Drive joint = together(robots, {}), by_itself = alone(robots, 1, {});
  EXPECT_EQ(joint.landmarks.size(), places.size());
  EXPECT_LT(joint.map_rms_m, 0.05);
  EXPECT_LT(joint.fitted_map_rms_m, joint.map_rms_m + 1e-12);
  EXPECT_LT(joint.robots[1].rms_m, 0.1);
  EXPECT_LT(joint.robots[1].sigma_m.back(), 0.5 * by_itself.robots[0].sigma_m.back());
  EXPECT_GT(by_itself.longest_blind_s, 25);
  EXPECT_LT(joint.longest_blind_s, 1);
  EXPECT_GT(joint.took_s, 0);
  EXPECT_NEAR(joint.recorded_s, 39, 1.1);
}

TEST(RecordedTeam, IsSkippedWithoutTheRecording) {
  const testing::Scratch scratch;
  const char* before = std::getenv("INCOGNITA_DATA");
  const std::string kept = before ? before : "";
  setenv("INCOGNITA_DATA", scratch.folder().c_str(), 1);
  const LedgerEntry entry = mrclam.run({scratch.folder(), 1, {}});
  before ? setenv("INCOGNITA_DATA", kept.c_str(), 1) : unsetenv("INCOGNITA_DATA");
  EXPECT_NE(entry.skipped.find("MRCLAM"), std::string::npos) << entry.skipped;
  EXPECT_TRUE(entry.claims.empty());
  EXPECT_TRUE(entry.figures.empty());
}

}  // namespace
}  // namespace incognita::recorded_team
