// A simulated point-landmark world and its vehicles: which landmarks and vehicles each sensor measures, the
// values, and noise that is deterministic for a seed.
#include "incognita/world/points/point_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>

#include "incognita/math/angles.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "tests/scratch.hpp"
#include "tests/small_vectors.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::vec;

constexpr double pi = std::numbers::pi;

/// At rest, without noise, without limits of range or field of view.
SimulatedVehicle vehicle(const AnyMotion& motion, const AnySensor& sensor, const SmallVector& start) {
  const int inputs = inputs_of(motion);
  return {{motion,
           {start, SmallVector::Zero(chart_of(motion).tangent()), SmallVector::Zero(inputs),
            SmallVector::Constant(inputs, -1), SmallVector::Constant(inputs, 1)},
           {}},
          {sensor, SmallVector::Zero(chart_of(sensor).tangent())}};
}

/// Landmarks all around on the plane, with identities 10, 11, ...
PointLandmarks ring(int count, double radius_m) {
  PointLandmarks place;
  for (int i = 0; i < count; ++i) {
    const double way = 2 * pi * i / count;
    place[10 + i] = vec({radius_m * std::cos(way), radius_m * std::sin(way)});
  }
  return place;
}

std::set<std::int64_t> names(const std::vector<PointDetection>& seen) {
  std::set<std::int64_t> all;
  for (const PointDetection& s : seen) all.insert(s.identity);
  return all;
}

/// The first observation of all.
Observation first_measurement(const std::vector<SimulatedVehicle>& team, const PointLandmarks& place,
                              bool see_each_other = false, std::uint64_t seed = 1) {
  SimulatedWorld world = point_world(team, seed);
  SensorSet sensors = point_sensors(team, {place, see_each_other}, seed);
  const Tick tick{0, 0, 0};
  return sensors.measure(world.move({}, tick), tick);
}

std::vector<PointDetection> seen_by(const SimulatedVehicle& v, const PointLandmarks& place) {
  return first_measurement({v}, place).bodies[0].landmarks;
}

TEST(PointDetector, MeasurementsAreExactWithoutNoise) {
  const SmallVector pose = vec({1, -2, 2.5});
  const PointLandmarks place = ring(16, 5);
  for (const bool ranges : {true, false}) {
    const AnySensor scanner = ranges ? AnySensor(RangeBearingSensor{}) : AnySensor(BearingSensor{});
    const Observation observation =
        first_measurement({vehicle(DifferentialDrive{0.3, 0}, scanner, pose)}, place);
    ASSERT_EQ(observation.bodies.size(), 1u);
    ASSERT_EQ(observation.bodies[0].landmarks.size(), 16u);
    for (const PointDetection& s : observation.bodies[0].landmarks) {
      const Eigen::Vector2d way = place.at(s.identity) - pose.head(2);
      const double bearing = wrap_angle(std::atan2(way.y(), way.x()) - pose[2]);
      EXPECT_NEAR(s.z[s.z.size() - 1], bearing, 1e-12);
      if (ranges) {
        EXPECT_NEAR(s.z[0], way.norm(), 1e-12);
      }
    }
    EXPECT_TRUE(observation.bodies[0].vehicles.empty());
  }
}

TEST(PointDetector, RespectsItsRange) {
  SimulatedVehicle v = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0}));
  v.sensor.limits.max_range_m = 5;
  const PointLandmarks place{
      {1, vec({4.999, 0})}, {2, vec({-3, 4})}, {3, vec({0, 5.001})}, {4, vec({50, 50})}};
  EXPECT_EQ(names(seen_by(v, place)), (std::set<std::int64_t>{1, 2}));
  SimulatedVehicle on_line = vehicle(MonobotMotion{}, RelativePositionSensor{}, vec({1}));
  on_line.sensor.limits.max_range_m = 2;
  EXPECT_EQ(names(seen_by(on_line, {{1, vec({-0.9})}, {2, vec({3.1})}, {3, vec({2})}})),
            (std::set<std::int64_t>{1, 3}));
}

TEST(PointDetector, RespectsItsFieldOfView) {
  for (const AnySensor& scanner : {AnySensor(RangeBearingSensor{}), AnySensor(BearingSensor{})}) {
    SimulatedVehicle v = vehicle(DifferentialDrive{}, scanner, vec({0, 0, pi}));  // faces -x
    const PointLandmarks place = ring(36, 3);
    v.sensor.limits.field_of_view_rad = radians(95);
    for (const PointDetection& s : seen_by(v, place)) EXPECT_LT(place.at(s.identity).x(), 0);
    EXPECT_EQ(seen_by(v, place).size(), 9u) << "10 degrees apart";
    v.sensor.limits.field_of_view_rad = 7;
    EXPECT_EQ(seen_by(v, place).size(), 36u) << "all around, also behind at the wrap";
  }
}

WideAngleCamera lens() {
  WideAngleCamera camera;
  camera.width = 320, camera.height = 240;
  camera.fu = camera.fv = 160, camera.u0 = 159.5, camera.v0 = 119.5;
  return camera;
}

/// The first tick includes a measurement, whatever its frame number.
TEST(PointDetector, MeasuresInItsFirstTick) {
  SimulatedVehicle v = vehicle(DifferentialDrive{0, 0}, RangeBearingSensor{}, vec({0, 0, 0}));
  v.sensor.ticks_per_measurement = 5;
  for (const std::int64_t first : {0, 17}) {
    SimulatedWorld world = point_world({v}, 1);
    SensorSet sensors = point_sensors({v}, {ring(4, 3)}, 1);
    for (int k = 0; k <= 10; ++k) {
      const Tick tick{first + k, 0.1 * k, k == 0 ? 0 : 0.1};
      EXPECT_EQ(sensors.measure(world.move({}, tick), tick).bodies[0].landmarks.empty(), k % 5 != 0)
          << first << "+" << k;
    }
  }
}

/// The range of a camera is a distance in space, also for a vehicle on the floor.
TEST(PointDetector, ACameraMeasuresWhatIsInItsImageAndWithinItsRange) {
  const CameraSensor camera{Camera(lens()), {.up_m = 0}};
  const PointLandmarks place{{1, vec({3, 0, 0})},    {2, vec({-3, 0, 0})},  {3, vec({3, 2.9, 0})},
                             {4, vec({3, 3.1, 0})},  {5, vec({3, 0, 2.1})}, {6, vec({3, 0, 2.3})},
                             {7, vec({0.1, 0, -50})}};
  for (const AnyMotion& motion :
       {AnyMotion(DifferentialDrive{}), AnyMotion(AckermannCar{}), AnyMotion(TerrainVehicle{})}) {
    SimulatedVehicle v = vehicle(motion, camera, vec({0, 0, 0}));
    EXPECT_EQ(names(seen_by(v, place)), (std::set<std::int64_t>{1, 3, 5}));
    v.sensor.limits.max_range_m = 3.5;
    EXPECT_EQ(names(seen_by(v, place)), (std::set<std::int64_t>{1})) << motion.index();
  }
}

TEST(PointDetector, ARangeIsNeverNegative) {
  SimulatedVehicle v = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0}));
  v.sensor.sigmas = vec({0.5, 0.1});
  PointLandmarks place;
  for (int i = 0; i < 1000; ++i) place[i] = vec({0.3, 0});
  const std::vector<PointDetection> seen = seen_by(v, place);
  for (const PointDetection& s : seen) EXPECT_GT(s.z[0], 0);
  // As many are omitted as a Gaussian has below -0.6 sigma
  EXPECT_NEAR(static_cast<double>(seen.size()), 1000 * 0.7257, 50);
}

TEST(PointDetector, HasTheStatedNoise) {
  SimulatedVehicle v = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0}));
  v.sensor.sigmas = vec({0.1, 0.02});
  v.sensor.sigma_range_ratio = 0.03;
  PointLandmarks place;
  for (int i = 0; i < 20'000; ++i) place[i] = vec({-10, 0});  // behind, at the wrap
  double range = 0, bearing = 0;
  for (const PointDetection& s : seen_by(v, place)) {
    EXPECT_LE(std::abs(s.z[1]), pi);
    range += std::pow(s.z[0] - 10, 2) / 20'000, bearing += std::pow(wrap_angle(s.z[1] - pi), 2) / 20'000;
  }
  EXPECT_NEAR(std::sqrt(range), 0.4, 0.01) << "0.1 m and three per cent of 10 m";
  EXPECT_NEAR(std::sqrt(bearing), 0.02, 0.0005);
}

TEST(PointDetector, VehiclesMeasureEachOtherButNotThemselves) {
  std::vector<SimulatedVehicle> team;
  for (const SmallVector& pose : {vec({0, 0, 0}), vec({3, 0, pi}), vec({20, 0, 1})})
    team.push_back(vehicle(DifferentialDrive{0.3, 0}, RangeBearingSensor{}, pose));
  team[1].sensor.limits.max_range_m = 10;
  team[2].sensor.limits.field_of_view_rad = 0.5;  // faces another way
  const Observation observation = first_measurement(team, ring(4, 2), true);
  ASSERT_EQ(observation.bodies.size(), 3u);
  EXPECT_EQ(names(observation.bodies[0].vehicles), (std::set<std::int64_t>{1, 2}));
  EXPECT_EQ(names(observation.bodies[1].vehicles), (std::set<std::int64_t>{0})) << "the third is too far";
  EXPECT_TRUE(observation.bodies[2].vehicles.empty());
  const PointDetection& other = observation.bodies[1].vehicles[0];
  EXPECT_NEAR(other.z[0], 3, 1e-12);
  EXPECT_NEAR(other.z[1], 0, 1e-12) << "they face each other";
  EXPECT_EQ(observation.bodies[0].landmarks.size(), 4u);
  const Observation blind = first_measurement(team, {}, false);
  for (const BodyObservation& view : blind.bodies) EXPECT_TRUE(view.vehicles.empty());
}

/// A camera measures other vehicles in space, also those with a planar state.
TEST(PointDetector, CamerasMeasureVehiclesOnTheFloor) {
  const CameraSensor camera{Camera(lens()), {.up_m = 1}};
  const std::vector<SimulatedVehicle> team{vehicle(DifferentialDrive{}, camera, vec({0, 0, 0})),
                                           vehicle(AckermannCar{}, camera, vec({4, 1, 0}))};
  const Observation observation = first_measurement(team, {}, true);
  ASSERT_EQ(observation.bodies[0].vehicles.size(), 1u);
  const SmallVector z = observation.bodies[0].vehicles[0].z;
  EXPECT_NEAR(z[0], 159.5 - 160 / 4.0, 1e-9) << "a meter to the left";
  EXPECT_NEAR(z[1], 119.5 + 160 / 4.0, 1e-9) << "and a meter below";
  EXPECT_TRUE(observation.bodies[1].vehicles.empty()) << "it is behind";
}

TEST(PointWorld, MovesEachVehicleAsCommandedAndReportsWhatItApplied) {
  const std::vector<SimulatedVehicle> team{
      vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0})),
      vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({5, 0, 0.1}))};
  SimulatedWorld world = point_world(team, 1);
  SensorSet sensors = point_sensors(team, {}, 1);
  const Tick first{0, 0, 0}, second{1, 0.5, 0.5};
  Command command;
  command.bodies = {{vec({0.4, 4})}};  // beyond its turn rate limit, and nothing for the other
  const auto before = world.move(command, first);
  EXPECT_EQ(before->bodies[0].state, vec({0, 0, 0})) << "no time has passed";
  const Observation at_first = sensors.measure(before, first);
  for (const BodyObservation& view : at_first.bodies) EXPECT_FALSE(view.input);
  const auto after = world.move(command, second);
  EXPECT_EQ(after->bodies[0].input, vec({0.4, 1}));
  EXPECT_EQ(after->bodies[1].input, vec({0, 0}));
  EXPECT_NEAR(after->bodies[0].state[2], 0.5, 1e-9);
  EXPECT_NEAR((after->bodies[1].state - vec({5, 0, 0.1})).norm(), 0, 1e-12) << "it stands";
  const Observation observation = sensors.measure(after, second);
  EXPECT_EQ(*observation.bodies[0].input, after->bodies[0].input);
  EXPECT_EQ(*observation.bodies[1].input, after->bodies[1].input);
  EXPECT_NEAR((after->bodies[0].pose->position.head<2>() - after->bodies[0].state.head<2>()).norm(), 0,
              1e-12);
}

/// The detections of a body's second sensor say so, and follow those of the first.
TEST(PointDetector, MayBeOneOfSeveralOnABody) {
  const SimulatedVehicle v = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0}));
  const PointTargets targets{ring(4, 3), false, std::set<std::int64_t>{}};
  const auto associations = std::make_shared<AssociationTruth>(1);
  SimulatedWorld world = point_world({v}, 1);
  SimulatedPointSensor second{BearingSensor{}, vec({0})};
  std::vector<BodySensors> bodies;
  bodies.push_back(sensors_of_body(
      std::make_unique<PointDetector>(v.body.motion, v.sensor, targets, 1, "first", associations),
      std::make_unique<PointDetector>(v.body.motion, second, targets, 1, "second", associations, 1)));
  SensorSet sensors(std::move(bodies));
  for (int k = 0; k < 2; ++k) {
    const Tick tick{k, 0.1 * k, k == 0 ? 0 : 0.1};
    const Observation observation = sensors.measure(world.move({}, tick), tick);
    const auto& seen = observation.bodies[0].landmarks;
    ASSERT_EQ(seen.size(), 8u);
    ASSERT_EQ(associations->at(0).size(), 8u);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].sensor, i < 4 ? 0 : 1);
      EXPECT_EQ(seen[i].z.size(), i < 4 ? 2 : 1);
      EXPECT_NEAR(wrap_angle(std::atan2(targets.landmarks.at(associations->at(0)[i]).y(),
                                        targets.landmarks.at(associations->at(0)[i]).x()) -
                             seen[i].z[seen[i].z.size() - 1]),
                  0, 1e-9);
    }
  }
}

TEST(PointDetector, WithholdsIdentitiesOutsideItsList) {
  const SimulatedVehicle v = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0.3}));
  const auto measurement = [&](const PointLandmarks& place) {
    SimulatedWorld world = point_world({v}, 1);
    const auto associations = std::make_shared<AssociationTruth>();
    SensorSet sensors =
        point_sensors({v}, {place, false, std::set<std::int64_t>{12, 13, 40}}, 1, associations);
    const Tick tick{0, 0, 0};
    const Observation observation = sensors.measure(world.move({}, tick), tick);
    return std::pair(observation.bodies[0].landmarks, associations->at(0));
  };
  const PointLandmarks place = ring(8, 5);  // identities 10 to 17
  const auto [seen, truth] = measurement(place);
  ASSERT_EQ(seen.size(), 8u);
  ASSERT_EQ(truth.size(), 8u);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].identity, i < 2 ? truth[i] : Detection::unknown);
    EXPECT_EQ(seen[i].z, seen_by(v, {{truth[i], place.at(truth[i])}}).front().z)
        << "its measurement is that of the landmark";
  }
  PointLandmarks renamed = place;
  std::swap(renamed[10], renamed[17]), std::swap(renamed[11], renamed[15]);
  const auto [again, other_truth] = measurement(renamed);
  EXPECT_NE(truth, other_truth);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].identity, again[i].identity);
    EXPECT_EQ(seen[i].z, again[i].z);
  }
}

/// All measurements of a team over some time, with disturbances.
std::vector<double> measurements_of(std::uint64_t seed, int vehicles) {
  std::vector<SimulatedVehicle> team;
  for (int i = 0; i < vehicles; ++i) {
    SimulatedVehicle v = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0.1 * i, 0, 0}));
    v.sensor.sigmas = vec({0.1, 0.02});
    v.body.plant.start_sigmas.setConstant(0.1), v.body.plant.input_sigmas.setConstant(0.1);
    team.push_back(v);
  }
  SimulatedWorld world = point_world(team, seed);
  SensorSet sensors = point_sensors(team, {ring(5, 4)}, seed);
  std::vector<double> numbers;
  for (int k = 0; k < 10; ++k) {
    const Tick tick{k, 0.1 * k, k ? 0.1 : 0};
    const Observation observation = sensors.measure(world.move({}, tick), tick);
    for (const PointDetection& s : observation.bodies[0].landmarks)
      numbers.insert(numbers.end(), s.z.begin(), s.z.end());
  }
  return numbers;
}

TEST(PointWorld, IsDeterministicForASeed) {
  EXPECT_EQ(measurements_of(3, 2), measurements_of(3, 2));
  EXPECT_NE(measurements_of(3, 2), measurements_of(4, 2));
  EXPECT_EQ(measurements_of(3, 1), measurements_of(3, 3))
      << "other vehicles do not change the first one's measurements";
}

TEST(PointWorld, RefusesInvalidSettings) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const SimulatedVehicle good = vehicle(DifferentialDrive{}, RangeBearingSensor{}, vec({0, 0, 0}));
  const auto complaint = [](const SimulatedVehicle& v, const PointLandmarks& place) {
    return message_of<std::invalid_argument>([&] { point_sensors({v}, {place}, 1); });
  };
  const auto changed = [&](auto change) {
    SimulatedVehicle v = good;
    change(v);
    return complaint(v, {});
  };
  EXPECT_EQ(complaint(good, ring(3, 1)), "(none)");
  EXPECT_HAS(message_of<std::invalid_argument>([] { point_world({}, 1); }), "needs a body");
  EXPECT_HAS(changed([](auto& v) { v.sensor.model = RelativePositionSensor{}; }),
             "needs a vehicle on a line");
  EXPECT_HAS(changed([](auto& v) { v.sensor.sigmas = vec({0.1}); }), "a sensor needs 2 sigmas");
  EXPECT_HAS(complaint(good, {{7, vec({1, 2, 3})}}),
             "landmark 7 has 3 numbers, but the sensor measures in 2");
  EXPECT_HAS(complaint(good, {{7, vec({1, nan})}}), "landmark 7");
  for (const double bad : {-0.1, nan}) {
    EXPECT_HAS(changed([&](auto& v) { v.sensor.sigmas[1] = bad; }), "zero or positive");
    EXPECT_HAS(changed([&](auto& v) { v.sensor.sigma_range_ratio = bad; }), "zero or positive");
    EXPECT_HAS(changed([&](auto& v) { v.sensor.limits.max_range_m = bad; }), "must be positive");
    EXPECT_HAS(changed([&](auto& v) { v.sensor.limits.field_of_view_rad = bad; }), "must be positive");
  }
  SensorSet sensors = point_sensors({good}, {}, 1);
  EXPECT_THROW(sensors.measure(std::nullopt, {}), std::invalid_argument);
  EXPECT_THROW(sensors.measure(Truth{}, {}), std::invalid_argument) << "another team's truth";
}

}  // namespace
}  // namespace incognita
