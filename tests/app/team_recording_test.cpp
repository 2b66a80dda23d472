// Five robots that detect each other, as recorded (UTIAS MRCLAM); skipped, with the reason, without the
// recording.
#include <gtest/gtest.h>

#include <cmath>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/world/replay/recorded_ranges.hpp"

namespace incognita {
namespace {

/// The odometry has commanded velocities, not wheel readings: its noise is mostly the robots' response.
BodyModel member_of(const RangeRecording& recording, double first_t) {
  BodyModel member = body_with_sensor(DifferentialDrive{}, RangeBearingSensor{}, {}, {}, {}, {});
  auto place = true_position(recording, first_t);
  for (double t = first_t; !place; t += 0.1) place = true_position(recording, t);
  member.start = Eigen::Vector3d(place->position.x(), place->position.y(), *place->heading_rad);
  member.start_sigmas = Eigen::Vector3d::Constant(0.01);
  member.input_sigmas = Eigen::Vector2d(0.1, 0.5);
  member.sensors[0].sigmas = Eigen::Vector2d(0.1, 0.02);
  member.sensors[0].sigma_range_ratio = 0.03;
  return member;
}

struct Errors {
  std::vector<double>
      rms_m;               ///< of each robot's position, against motion capture, in the frame of the starts
  double landmarks_m = 0;  ///< rms
  TrackingState state = TrackingState::starting;
};

Errors drive(const std::vector<RangeRecording>& robots, bool see_each_other) {
  const auto shared = std::make_shared<const std::vector<RangeRecording>>(robots);
  ReplayClock clock(scan_times(robots, 900));
  SensorSet sensors = recorded_ranges(shared, {.measures_vehicles = see_each_other});
  Tick tick = clock.next();
  EstimatorSettings settings;
  settings.filter.gate_probability = 0.999;
  for (const RangeRecording& robot : robots) settings.bodies.push_back(member_of(robot, tick.t));
  SlamEstimator estimator(settings);
  Estimate estimate;
  std::vector<double> squares(robots.size()), count(robots.size());
  for (; tick; tick = clock.next()) {
    estimator.update(estimate, {}, sensors.measure({}, tick), tick);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const auto place = true_position(robots[i], tick.t);
      if (!place) continue;
      const Eigen::Vector2d estimated = estimate.belief.mean(estimate.bodies[i].block).head<2>();
      squares[i] += (estimated - place->position).squaredNorm();
      ++count[i];
    }
  }
  Errors errors{{}, 0, estimate.status.state};
  for (std::size_t i = 0; i < robots.size(); ++i) errors.rms_m.push_back(std::sqrt(squares[i] / count[i]));
  for (const auto& surveyed : robots.front().landmarks) {
    const Eigen::Vector2d estimated = estimate.belief.mean(estimate.landmarks.at(surveyed.identity).block);
    errors.landmarks_m += (estimated - surveyed.position).squaredNorm();
  }
  errors.landmarks_m = std::sqrt(errors.landmarks_m / static_cast<double>(robots.front().landmarks.size()));
  return errors;
}

TEST(TeamRecording, RelativeDetectionsReduceErrors) {
  std::vector<RangeRecording> robots;
  try {
    robots = read_mrclam_team(find_data("mrclam/MRCLAM_Dataset7", "", "test"));
  } catch (const InputError& error) {
    GTEST_SKIP() << error.what();
  }
  ASSERT_EQ(robots.size(), 5u);
  const Errors joint = drive(robots, true);
  EXPECT_EQ(joint.state, TrackingState::tracking);
  EXPECT_LT(joint.landmarks_m, 0.15);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Errors alone = drive({robots[i]}, false);
    EXPECT_LT(joint.rms_m[i], 0.2) << "robot " << i + 1;
    EXPECT_LT(joint.rms_m[i], 0.8 * alone.rms_m[0]) << "robot " << i + 1;
  }
}

}  // namespace
}  // namespace incognita
