// Lost is a matter of the landmarks around: a consistent vehicle far from its start is tracked, a blind one is lost.
#include "incognita/slam/mapper/relative_sigma.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/arc_motion.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/health.hpp"

namespace incognita {
namespace {

using Pose = planar::Pose<double>;

PlanarSlamSettings road_settings() {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.vehicle.sigma_speed_m_s = 0.2;
  s.vehicle.sigma_turn_rate_rad_s = 0.02;
  s.sensor.sigma_range_m = 0.1;
  s.association.method = DataAssociationSettings::Method::known;
  s.association.gate_probability = 0.999999;
  s.start.sigma_heading_rad = 0.1;
  return s;
}

/// A straight road with posts every 10 m on both sides, at 10 m/s, a scan a second.
struct Road {
  PlanarSlamSettings s;
  SlamEstimator estimator;
  Estimate e;
  Pose truth{0, 0, 0};
  RandomStream random{1, "road"};
  std::int64_t frame = 0;

  explicit Road(const PlanarSlamSettings& settings = road_settings())
      : s(settings), estimator(single_vehicle(settings)) {}

  void step(bool blind = false) {
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    const double t = static_cast<double>(frame);
    const Eigen::Vector2d input(10, 0);
    if (frame > 0) {
      const Eigen::Vector2d off(s.vehicle.sigma_speed_m_s * random.normal(),
                                s.vehicle.sigma_turn_rate_rad_s * random.normal());
      truth = ArcMotion<DifferentialDrive>{}.f<double>(truth, input + off, 1);
    }
    body.odometry = {{t, input}};
    for (int i = -2; i <= 2 && !blind; ++i)
      for (const int side : {-1, 1}) {
        const auto at = std::llround(truth.x() / 10) + i;
        const Eigen::Vector2d post(10.0 * static_cast<double>(at), 8.0 * side);
        const Eigen::Vector2d seen = RangeBearing::h<double>(truth, post);
        if (seen[0] > 40) continue;
        body.landmarks.push_back(
            {2 * (at + 1000) + (side > 0),
             Eigen::Vector2d(seen[0] + s.sensor.sigma_range_m * random.normal(),
                             wrap_angle(seen[1] + s.sensor.sigma_bearing_rad * random.normal()))});
      }
    estimator.update(e, {}, observation, {frame, t, frame > 0 ? 1.0 : 0.0});
    ++frame;
  }
};

TEST(RelativeSigma, KeepsAVehicleFarFromItsStartTracked) {
  Road road;
  for (int k = 0; k < 60; ++k) {
    road.step();
    ASSERT_EQ(road.e.status.state, TrackingState::tracking) << k << ": " << road.e.status.reason;
  }
  EXPECT_GT(sigma_position(road.e.bodies[0]), 10) << "for 0.1 rad at the start";
  const auto relative = relative_sigma(road.e, 0, road.estimator.settings());
  ASSERT_TRUE(relative);
  EXPECT_LT(relative->sigma_m, 1);
  EXPECT_NEAR(relative->distance_m, 15, 10);
}

TEST(RelativeSigma, ALimitInTheWorldIsOnePutByHand) {
  PlanarSlamSettings s = road_settings();
  s.health.max_sigma_position_m = 5;
  Road road(s);
  for (int k = 0; k < 60; ++k) road.step();
  EXPECT_EQ(road.e.status.state, TrackingState::lost);
  EXPECT_NE(road.e.status.reason.find("limit 5 m"), std::string::npos) << road.e.status.reason;
}

TEST(RelativeSigma, ABlindVehicleIsLost) {
  Road road;
  for (int k = 0; k < 10; ++k) road.step();
  int blind = 0;
  for (; road.e.status.state != TrackingState::lost && blind < 200; ++blind) road.step(true);
  EXPECT_GT(blind, 3);
  EXPECT_LT(blind, 100);
  EXPECT_NE(road.e.status.reason.find("relative to what was matched last"), std::string::npos)
      << road.e.status.reason;
  EXPECT_NE(road.e.status.reason.find("limit 0.5 of the distance"), std::string::npos)
      << road.e.status.reason;
}

TEST(RelativeSigma, TheShareOfTheDistanceIsASetting) {
  const auto blind_ticks = [](double max_ratio) {
    PlanarSlamSettings s = road_settings();
    s.health.max_sigma_ratio = max_ratio;
    Road road(s);
    for (int k = 0; k < 10; ++k) road.step();
    int blind = 0;
    for (; road.e.status.state != TrackingState::lost && blind < 300; ++blind) road.step(true);
    return blind;
  };
  EXPECT_LT(blind_ticks(0.1), blind_ticks(0.5));
}

TEST(RelativeSigma, WithoutAnyLandmarkTheGrowthSinceTheStartIsLimited) {
  Road road;
  int ticks = 0;
  for (; road.e.status.state != TrackingState::lost && ticks < 200; ++ticks) road.step(true);
  EXPECT_LT(ticks, 100);
  EXPECT_GT(sigma_position(road.e.bodies[0]), 10);
  EXPECT_NE(road.e.status.reason.find("without a landmark, limit 10 m"), std::string::npos)
      << road.e.status.reason;
}

TEST(RelativeSigma, TheVehicleIsTrackedAgainWhenItMatches) {
  Road road;
  for (int k = 0; k < 10; ++k) road.step();
  const auto matched = road.e.bodies[0].matched_last;
  ASSERT_FALSE(matched.empty());
  road.step(true);
  EXPECT_EQ(road.e.bodies[0].matched_last.size(), matched.size()) << "what was matched last is kept";
  road.step();
  EXPECT_EQ(road.e.status.state, TrackingState::tracking) << road.e.status.reason;
}

/// An anchor is fixed, and a map in the vehicle frame moves around the vehicle: the relative sigma is the same.
TEST(RelativeSigma, IsTheSameInEitherFrame) {
  std::vector<double> sigmas;
  for (const MapFrame frame : {MapFrame::world, MapFrame::vehicle}) {
    PlanarSlamSettings s = road_settings();
    s.filter.map_frame = frame;
    Road road(s);
    for (int k = 0; k < 6; ++k) road.step();
    for (int k = 0; k < 3; ++k) road.step(true);
    const auto relative = relative_sigma(road.e, 0, road.estimator.settings());
    ASSERT_TRUE(relative);
    sigmas.push_back(relative->sigma_m);
  }
  EXPECT_NEAR(sigmas[0], sigmas[1], 0.1 * sigmas[0]);
}

}  // namespace
}  // namespace incognita
