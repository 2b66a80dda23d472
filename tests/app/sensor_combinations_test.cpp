// Several sensors on one body, in the rendered room: two cameras, and a camera with a scanner. Each combination runs
// over fixed seeds, and the normalized estimation error of the pose (NEES) must be inside its chi-square band.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "tests/world/camera_in_room.hpp"

namespace incognita {
namespace {

constexpr double rate_hz = 30;
constexpr int room_seeds = 8;

/// The room with all errors of a match taken for white: invariant errors are derived for one camera. One room for all seeds, since
/// painting its textures takes longest.
struct Setup {
  LoadedScenario loaded =
      load_scenario("room", std::vector<std::string>{"sensor.sigma_pixel_px=0.4", "sensor.sigma_lasting_px=0",
                                                     "estimator.invariant=false"});
  const Scenario& scenario = loaded.scenario;
  Camera camera = make_camera(scenario.camera);
  Target target = load_target(loaded);
  std::shared_ptr<const Room> room = std::make_shared<const Room>(scenario.room, 1);
};

const Setup& setup() {
  static const Setup shared;
  return shared;
}

Tick tick_of(int k) { return {k, k / rate_hz, k == 0 ? 0 : 1 / rate_hz}; }

std::shared_ptr<const Image> image_from(RoomCamera& camera, const CameraState& pose, const Tick& tick) {
  return camera.image_from(pose_of(FreeCameraMotion{}, pose), tick);
}

/// The outcome of one run.
struct Ran {
  double nees = 0, sigma_m = 0;                       ///< at the end
  std::vector<int> matches = std::vector<int>(2, 0);  ///< per camera, all frames
  int scanned = 0;                                    ///< detections that corrected the filter, all ticks
  bool lost = false;

  void count(const Estimate& estimate) {
    lost = lost || estimate.status.state == TrackingState::lost;
    for (const Match& match : estimate.last.matches) {
      if (match.outcome != MatchOutcome::matched || match.ray) continue;
      if (match.image)
        ++matches.at(static_cast<std::size_t>(match.sensor));
      else
        ++scanned;
    }
  }
};

/// The filter is conservative at first, since a patch errs by less than 0.4 px: the band of a
/// single run is the lower limit, that of all runs the upper one.
void expect_in_band(const char* name, const std::vector<Ran>& runs, int dof) {
  double nees = 0;
  for (const Ran& run : runs) nees += run.nees;
  const auto n = static_cast<int>(runs.size());
  const double least = chi_square_quantile(0.005, dof) * n, most = chi_square_quantile(0.9995, dof * n);
  std::printf("%s: NEES %.2f per degree of freedom (%.2f to %.2f)\n", name, nees / (dof * n),
              least / (dof * n), most / (dof * n));
  EXPECT_GT(nees, least) << name;
  EXPECT_LT(nees, most) << name;
  for (const Ran& run : runs) EXPECT_FALSE(run.lost) << name;
}

// Two cameras

/// The second camera faces to the right of the first, 0.1 m beside it; the axes of the body are those of the
/// first camera.
const Mount second_camera{.forward_m = 0.1, .left_m = 0, .up_m = 0};

CameraState second_pose(const CameraState& first) {
  const PoseOf<6> body{{free_camera::position(first), free_camera::orientation(first)},
                       Eigen::Matrix<double, 6, 6>::Identity()};
  return second_camera.on(body).camera;
}

SlamEstimator with_cameras(int count, std::uint64_t seed) {
  const Scenario& s = setup().scenario;
  EstimatorSettings settings;
  settings.bodies.push_back(free_camera_body(s.slam.filter));
  settings.health = s.slam.health;
  std::vector<FeatureTracker> cameras;
  cameras.emplace_back(setup().camera, s.slam, CameraPlacement{.target = setup().target}, seed);
  if (count == 2)
    cameras.emplace_back(setup().camera, s.slam, CameraPlacement{.mount = second_camera}, seed + 1);
  return SlamEstimator(std::move(settings), std::move(cameras));
}

/// Sways to the side and up, with a swing of the gaze, so that depths become observable.
Command sway(double t) {
  FreeCameraMotion::Input<double> input;
  input << 0.1 * std::cos(t), 0.5 * std::cos(2.1 * t), 0.4 * std::cos(2.6 * t + 1), 0, 0.25 * std::cos(2 * t),
      0;
  return {{BodyCommand{input}}};
}

Ran fly(int cameras, std::uint64_t seed) {
  const Scenario& s = setup().scenario;
  testing::CameraInRoom plant(s.room, setup().room->layout(), seed);
  RoomCamera first(setup().room, setup().camera, s.room, seed),
      second(setup().room, setup().camera, s.room, seed, "sensor.image-2");
  SlamEstimator estimator = with_cameras(cameras, seed);
  Estimate estimate;
  Command command;
  Ran ran;
  CameraState truth;
  for (int k = 0; k <= 3 * rate_hz; ++k) {
    truth = plant.move(input_of(command_of(command, 0), 6), tick_of(k).dt);
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    body.images = {image_from(first, truth, tick_of(k)), image_from(second, second_pose(truth), tick_of(k))};
    estimator.update(estimate, command, observation, tick_of(k));
    command = sway(tick_of(k).t);
    ran.count(estimate);
  }
  Eigen::Matrix<double, 12, 1> error;
  const CameraState mean = estimate.camera_state();
  FreeCameraMotion::chart.minus({truth.data(), 13}, {mean.data(), 13}, {error.data(), 12});
  const Eigen::Matrix<double, 6, 6>& P = estimate.body().pose_covariance;
  ran.nees = error.head<6>().dot(P.llt().solve(error.head<6>()));
  ran.sigma_m = std::sqrt(P.topLeftCorner<3, 3>().trace());
  return ran;
}

TEST(SensorCombinations, TwoCamerasOnOneBody) {
  std::vector<Ran> two;
  for (int seed = 1; seed <= room_seeds; ++seed) {
    two.push_back(fly(2, static_cast<std::uint64_t>(seed)));
    EXPECT_GT(two.back().matches[0], 200) << "seed " << seed;
    EXPECT_GT(two.back().matches[1], 200) << "seed " << seed;
  }
  expect_in_band("two cameras on one body", two, 6);
  const Ran one = fly(1, 1);
  EXPECT_EQ(one.matches[1], 0);
  EXPECT_LT(two[0].sigma_m, one.sigma_m) << "the second camera adds information";
}

// A camera and a scanner

const Mount on_vehicle{.forward_m = 0.1, .left_m = 0, .up_m = 1.3};
constexpr double sigma_range_m = 0.02, sigma_bearing_rad = 0.01, sigma_speed_m_s = 0.03,
                 sigma_turn_rad_s = 0.03;

/// A planar vehicle that carries a scanner, whose landmarks are posts on the plane, and a camera.
SlamEstimator with_camera_and_scanner(const Eigen::Vector3d& start, bool camera, bool scanner,
                                      std::uint64_t seed) {
  const Scenario& s = setup().scenario;
  EstimatorSettings settings;
  BodyModel body = body_with_sensor(
      DifferentialDrive{}, make_sensor("range-bearing", traits_of(AnyMotion(DifferentialDrive{}))), start,
      Eigen::Vector3d(0.02, 0.02, 0.01), Eigen::Vector2d(sigma_speed_m_s, sigma_turn_rad_s),
      Eigen::Vector2d(sigma_range_m, sigma_bearing_rad));
  if (!scanner) body.sensors.clear();
  settings.bodies.push_back(body);
  settings.health.max_sigma_position_m = 1;
  std::vector<FeatureTracker> cameras;
  if (camera) cameras.emplace_back(setup().camera, s.slam, CameraPlacement{.mount = on_vehicle}, seed);
  return SlamEstimator(std::move(settings), std::move(cameras));
}

std::vector<PointDetection> scan(const Eigen::Vector3d& vehicle, RandomStream& random) {
  std::vector<PointDetection> detections;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector2d post(2.2 * std::cos(i), 2.2 * std::sin(i));
    Eigen::Vector2d z = RangeBearing::h<double>(vehicle, post);
    z[0] += sigma_range_m * random.normal();
    z[1] = wrap_angle(z[1] + sigma_bearing_rad * random.normal());
    detections.push_back({i, z});  // the numbers that features would have without detections
  }
  return detections;
}

Ran drive(bool camera, bool scanner, std::uint64_t seed) {
  const Scenario& s = setup().scenario;
  RandomStream random(seed, "drive");
  RoomCamera lens(setup().room, setup().camera, s.room, seed);
  const Eigen::Vector3d start(1, -0.4, 0.2);
  Eigen::Vector3d truth =
      start + Eigen::Vector3d(0.02 * random.normal(), 0.02 * random.normal(), 0.01 * random.normal());
  SlamEstimator estimator = with_camera_and_scanner(start, camera, scanner, seed);
  Estimate estimate;
  Ran ran;
  for (int k = 0; k <= 4 * rate_hz; ++k) {
    const Eigen::Vector2d input(0.3, 0.25 * std::cos(k / rate_hz));
    const Eigen::Vector2d executed =
        input + Eigen::Vector2d(sigma_speed_m_s * random.normal(), sigma_turn_rad_s * random.normal());
    if (k > 0) truth = ArcMotion<DifferentialDrive>{}.f<double>(truth, executed, 1 / rate_hz);
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    body.input = input;
    if (camera) body.images = {image_from(lens, on_vehicle.on(on_floor(truth)).camera, tick_of(k))};
    if (scanner && k % 3 == 0) body.landmarks = scan(truth, random);
    estimator.update(estimate, {}, observation, tick_of(k));
    ran.count(estimate);
  }
  Eigen::Vector3d error = truth - Eigen::Vector3d(estimate.body().state);
  error[2] = wrap_angle(error[2]);
  const Eigen::Matrix3d P = estimate.body().state_covariance;
  ran.nees = error.dot(P.llt().solve(error));
  ran.sigma_m = std::sqrt(P.topLeftCorner<2, 2>().trace());
  return ran;
}

/// With a covered lens and too few posts the estimate is lost, but the scanner and the odometry still localize the body.
TEST(SensorCombinations, ABodyWithAScannerDoesNotWaitForItsCamera) {
  SlamEstimator estimator = with_camera_and_scanner({0, 0, 0}, true, true, 1);
  const auto dark = std::make_shared<Image>(setup().camera.width(), setup().camera.height());
  Estimate estimate;
  int lost = 0;
  for (int k = 0; k <= 60; ++k) {
    const Eigen::Vector3d truth(0.3 * k / rate_hz, 0, 0);
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    body.input = Eigen::Vector2d(0.3, 0);
    body.images = {dark};
    for (int i = 0; i < 2; ++i)
      body.landmarks.push_back({i, RangeBearing::h<double>(truth, Eigen::Vector2d(2, 1 - 2 * i))});
    estimator.update(estimate, {}, observation, tick_of(k));
    lost += estimate.status.state == TrackingState::lost;
    EXPECT_LT((estimate.body().pose.position.head<2>() - truth.head<2>()).norm(), 0.05) << k;
  }
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, 30) << "relocated by the scanner";
}

TEST(SensorCombinations, ACameraAndAScannerOnOneBody) {
  std::vector<Ran> both;
  for (int seed = 1; seed <= room_seeds; ++seed) {
    both.push_back(drive(true, true, static_cast<std::uint64_t>(seed)));
    EXPECT_GT(both.back().matches[0], 300) << "seed " << seed;
    EXPECT_GT(both.back().scanned, 150) << "seed " << seed;
  }
  expect_in_band("a camera and a scanner on one body", both, 3);
  EXPECT_LT(both[0].sigma_m, drive(true, false, 1).sigma_m) << "than with the camera alone";
  EXPECT_LT(both[0].sigma_m, drive(false, true, 1).sigma_m) << "than with the scanner alone";
}

}  // namespace
}  // namespace incognita
