// The simulated environment of thesis Appendix B: every motion model with every sensor, filter and controller
// that fits.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "incognita/control/steering_controller.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita {
namespace {

SmallVector vec(std::initializer_list<double> numbers) {
  SmallVector v(static_cast<Eigen::Index>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), v.begin());
  return v;
}

/// Vehicles in a world, their filter, and their paths.
struct Scene {
  std::vector<SimulatedVehicle> vehicles;
  EstimatorSettings filter;
  std::vector<SteeringSettings> steering;
  PointLandmarks place;
  double rate_hz = 10;
  bool see_each_other = false;

  void add(const BodyModel& member, const SteeringSettings& steer, double max_range_m) {
    SimulatedVehicle v{
        {member.motion,
         {member.start, member.start_sigmas, member.input_sigmas, -steer.most_input, steer.most_input},
         {}},
        {member.sensors[0].sensor, member.sensors[0].sigmas, member.sensors[0].sigma_range_ratio}};
    v.sensor.limits.max_range_m = max_range_m;
    vehicles.push_back(v);
    filter.bodies.push_back(member);
    steering.push_back(steer);
  }
};

struct Result {
  Estimate estimate;
  double nees = 0;              ///< mean of all vehicles, divided by its degrees of freedom
  double tracking_m = 0;        ///< true distance from the path, mean of the last third
  double position_error_m = 0;  ///< largest, at the end
};

double nees_of(const Scene& scene, const Estimate& estimate, const Truth& truth, std::size_t i) {
  const Chart& chart = chart_of(scene.vehicles[i].body.motion);
  const SmallVector mean = estimate.belief.mean(estimate.bodies[i].block), t = truth.bodies[i].state;
  Eigen::VectorXd e(chart.tangent());
  chart.minus({t.data(), static_cast<std::size_t>(t.size())},
              {mean.data(), static_cast<std::size_t>(mean.size())},
              {e.data(), static_cast<std::size_t>(e.size())});
  const Eigen::MatrixXd P = estimate.belief.covariance(estimate.bodies[i].block);
  return e.dot(P.ldlt().solve(e)) / static_cast<double>(e.size());
}

Result run(const Scene& scene, double duration_s, std::uint64_t seed) {
  SimulatedWorld world = point_world(scene.vehicles, seed);
  SensorSet sensors = point_sensors(scene.vehicles, {scene.place, scene.see_each_other}, seed);
  SlamEstimator estimator(scene.filter);
  std::vector<BodyControl> steered;
  for (std::size_t i = 0; i < scene.steering.size(); ++i)
    steered.push_back({scene.vehicles[i].body.motion, scene.steering[i]});
  SteeringController controller(std::move(steered), 1 / scene.rate_hz);
  FixedRateClock clock(scene.rate_hz, duration_s);
  Result result;
  Command command;
  int all = 0, late = 0;
  while (const Tick tick = clock.next()) {
    const auto truth = world.move(command, tick);
    estimator.update(result.estimate, command, sensors.measure(truth, tick), tick);
    command = controller.act(result.estimate, {}, {}, tick);
    result.position_error_m = 0;
    for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
      const AnyMotion& motion = scene.vehicles[i].body.motion;
      const SmallVector at_truth = position_of(motion, truth->bodies[i].state).position;
      const SmallVector estimated =
          position_of(motion, result.estimate.belief.mean(result.estimate.bodies[i].block)).position;
      result.position_error_m = std::max(result.position_error_m, (at_truth - estimated).norm());
      if (tick.frame > 0) result.nees += nees_of(scene, result.estimate, *truth, i), ++all;
      if (tick.t < duration_s * 2 / 3) continue;
      const Reference reference = at(scene.steering[i].path, tick.t);
      const auto size = std::min<Eigen::Index>(at_truth.size(), 2);
      result.tracking_m += (reference.position.head(size) - at_truth.head(size)).norm(), ++late;
    }
  }
  result.nees /= all;
  result.tracking_m /= late;
  return result;
}

PointLandmarks drawn_landmarks(int count, int dimensions, double half_m, double height_m) {
  PointLandmarks place;
  RandomStream random(7, "place");
  for (int i = 0; i < count; ++i) {
    place[i] = SmallVector(dimensions);
    for (int k = 0; k < dimensions; ++k)
      place[i][k] = k < 2 ? random.uniform(-half_m, half_m) : random.uniform(0, height_m);
  }
  return place;
}

Camera wide_angle() {
  WideAngleCamera camera;
  camera.width = 320, camera.height = 240;
  camera.fu = camera.fv = 160, camera.u0 = 159.5, camera.v0 = 119.5;
  return camera;
}

/// A registered motion model with its sensor off the axle, as control laws require.
AnyMotion motion_named(const std::string& name) {
  AnyMotion motion = make_motion(name);
  const bool steers = traits_of(motion).has_input("steering");
  const std::map<std::string, double> values{{"wheelbase_m", 1},
                                             {"wheel_left_m", 0.3},
                                             {"sensor_forward_m", steers ? 0.8 : 0.3},
                                             {"sensor_left_m", 0}};
  set_model_parameters(motion, [&](const std::string& key, double usual) {
    const auto found = values.find(key);
    return found == values.end() ? usual : found->second;
  });
  set_terrain(motion, Waves{0, {{0.15, 6, 0.3, 0}, {0.1, 4, 1.7, 1}}});
  return motion;
}

AnySensor sensor_named(const std::string& word, const AnyMotion& motion) {
  AnySensor sensor = make_sensor(word, traits_of(motion));
  set_camera(sensor, wide_angle(), Mount{0.1, 0, 0.6, 0, 0});
  set_model_parameters(
      sensor, [](const std::string& key, double usual) { return key == "baseline_m" ? 0.3 : usual; });
  return sensor;
}

SmallVector sigmas_of(const AnySensor& sensor) {
  const bool measures_range = traits_of(sensor).measures("range");
  return values_of(traits_of(sensor).measurement,
                   {{"range_m", 0.1}, {"bearing_rad", measures_range ? 0.02 : 0.01}, {"pixel_px", 1.0}});
}

/// A vehicle on a circle, or on a line to a point; its world has what the sensor needs to localize.
Scene scene_of(const AnyMotion& motion, const AnySensor& sensor, Linearization linearization,
               BeliefForm form = BeliefForm::covariance) {
  Scene scene;
  BodyModel member = body_with_sensor(motion, sensor, {}, {}, {}, sigmas_of(sensor));
  SteeringSettings steer;
  steer.law = ControlLaw::feedback_linearization;
  const bool free = traits_of(motion).in_space(), line = traits_of(motion).on_line();
  member.start = free   ? at_rest(motion, {-1.5, 0, 1.2}, 0)
                 : line ? vec({0})
                        : at_rest(motion, {4, -1, 0}, 1.57);
  member.start_sigmas = SmallVector::Constant(chart_of(motion).tangent(), 0.01);
  if (free && form == BeliefForm::covariance)
    member.start_sigmas.tail(6).setZero();  // it is at rest, exactly
  member.input_sigmas = free ? SmallVector::Constant(6, 0.2) : SmallVector::Constant(inputs_of(motion), 0.05);
  if (free) {
    BackAndForthPath path;
    path.center = {0, 0, 1.2};
    steer.path = path;
    steer.most_input = SmallVector::Constant(6, 3);
  } else if (line) {
    steer.path = PointPath{{5, 0, 0}};
    steer.most_input = vec({1});
    steer.law = ControlLaw::lqg;
  } else {
    CirclePath path;
    path.radius_m = 4;
    path.rate_rad_s = 0.12;
    steer.path = path;
    steer.most_input = traits_of(motion).has_input("steering") ? vec({1.5, 0.6}) : vec({1.5, 1});
  }
  const int dimensions = dimensions_of(sensor);
  scene.place = drawn_landmarks(dimensions == 3 ? 60 : 20, dimensions, line ? 12 : 8, 2.5);
  scene.rate_hz = dimensions == 3 ? 20 : 10;
  scene.filter.filter.linearization = linearization;
  scene.filter.filter.form = form;
  if (!measures_distance(sensor))  // they fix position and scale
    for (int i = 0; i < (dimensions == 3 ? 8 : 4); ++i) scene.filter.anchors[i] = scene.place[i];
  scene.add(member, steer, 1e9);
  return scene;
}

using Combination = std::tuple<std::string, std::string, Linearization, BeliefForm>;
/// Compatibility; first-estimate Jacobians are derived for planar points and planar poses only.
bool makes_sense(const AnyMotion& motion, const AnySensor& sensor, Linearization linearization) {
  if (!incompatibility(motion, sensor).empty()) return false;
  return linearization != Linearization::first_estimate ||
         (traits_of(motion).is_planar_pose() && dimensions_of(sensor) == 2 && measures_distance(sensor));
}

class Combinations : public ::testing::TestWithParam<Combination> {};

TEST_P(Combinations, IsConsistentOrRefused) {
  const auto [motion_name, sensor_name, linearization, form] = GetParam();
  const AnyMotion motion = motion_named(motion_name);
  const AnySensor sensor = sensor_named(sensor_name, motion);
  const Scene scene = scene_of(motion, sensor, linearization, form);
  const std::string problem = validate(scene.filter);
  ASSERT_EQ(problem.empty(), makes_sense(motion, sensor, linearization)) << problem;
  if (!problem.empty()) {
    EXPECT_THROW(SlamEstimator{scene.filter}, std::invalid_argument);
    EXPECT_GT(problem.size(), 40u) << "the reason as a sentence";
    return;
  }
  double nees = 0;
  constexpr int seeds = 4;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Result result = run(scene, 20, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(result.estimate.status.state, TrackingState::tracking) << result.estimate.status.reason;
    EXPECT_LT(result.position_error_m, 0.5);
    EXPECT_LT(result.tracking_m, 0.6);
    EXPECT_GT(result.estimate.landmarks.size(), 5u);
    nees += result.nees / seeds;
  }
  RecordProperty("nees", std::to_string(nees));
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 3.0);
}

constexpr const char* linearization_names[] = {"analytic", "iterated", "unscented_vehicle", "first_estimate"};

std::string name_of(const ::testing::TestParamInfo<Combination>& info) {
  std::string name = std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param) + "_" +
                     linearization_names[static_cast<std::size_t>(std::get<2>(info.param))] +
                     (std::get<3>(info.param) == BeliefForm::covariance ? "_covariance" : "_information");
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    All, Combinations,
    ::testing::Combine(::testing::ValuesIn(motion_names()), ::testing::ValuesIn(sensor_words()),
                       ::testing::Values(Linearization::analytic, Linearization::iterated,
                                         Linearization::unscented_vehicle, Linearization::first_estimate),
                       ::testing::Values(BeliefForm::covariance, BeliefForm::information)),
    name_of);

/// Three vehicles on circles side by side, with a range of 6 m.
Scene three_on_circles(bool see_each_other, int landmarks, double sigma_start) {
  Scene scene;
  scene.see_each_other = see_each_other;
  scene.place = drawn_landmarks(landmarks, 2, 12, 0);
  for (int i = 0; i < 3; ++i) {
    const SmallVector at_start = SmallVector::Constant(3, sigma_start);
    const BodyModel member =
        body_with_sensor(DifferentialDrive{0.3, 0}, RangeBearingSensor{}, vec({4.0 * i - 4, -1, 1.57}),
                         at_start, vec({0.1, 0.1}), vec({0.1, 0.02}));
    SteeringSettings steer;
    steer.law = ControlLaw::feedback_linearization;
    CirclePath path;
    path.center = {4.0 * i - 4, 0, 0};
    path.radius_m = 3;
    path.rate_rad_s = 0.15;
    steer.path = path;
    steer.most_input = vec({1.5, 1});
    scene.add(member, steer, 6);
  }
  return scene;
}

TEST(Team, RelativeDetectionsReduceUncertainty) {
  double together = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const bool see : {false, true})
      (see ? together : apart) += run(three_on_circles(see, 6, 0), 40, seed).position_error_m;
  EXPECT_LT(together, 0.9 * apart);
}

/// Difference of two estimates of the same blocks: means in sigmas, covariances in products of sigmas.
double apart(const AnyBelief& a, const AnyBelief& b, const std::vector<BlockId>& blocks) {
  const Eigen::MatrixXd P = a.dense_covariance(), Q = b.dense_covariance();
  if (P.rows() != Q.rows()) return INFINITY;
  const Eigen::VectorXd scale = P.diagonal().cwiseSqrt().cwiseInverse();
  double most = (scale.asDiagonal() * (P - Q) * scale.asDiagonal()).cwiseAbs().maxCoeff();
  for (const BlockId block : blocks) {
    const Eigen::VectorXd x = a.mean(block), y = b.mean(block);
    Eigen::VectorXd error(a.chart(block).tangent());
    a.chart(block).minus({x.data(), static_cast<std::size_t>(x.size())},
                         {y.data(), static_cast<std::size_t>(y.size())},
                         {error.data(), static_cast<std::size_t>(error.size())});
    most = std::max(most,
                    error.cwiseProduct(scale.segment(a.offset(block), error.size())).cwiseAbs().maxCoeff());
  }
  return most;
}

std::vector<BlockId> blocks_of(const Estimate& estimate) {
  std::vector<BlockId> blocks;
  for (const Body& vehicle : estimate.bodies) blocks.push_back(vehicle.block);
  for (const auto& [id, landmark] : estimate.landmarks)
    if (!landmark.fixed) blocks.push_back(landmark.block);
  return blocks;
}

class Forms : public ::testing::TestWithParam<std::tuple<Linearization, bool>> {};

TEST_P(Forms, GiveTheSameEstimate) {
  const auto [linearization, known_map] = GetParam();
  Scene scene = three_on_circles(true, 20, 0.01);
  scene.filter.filter.linearization = linearization;
  scene.filter.filter.gate_probability = 0.999;
  if (known_map) scene.filter.anchors = scene.place;
  EstimatorSettings changed = scene.filter;
  changed.filter.form = BeliefForm::information;
  SlamEstimator covariance(scene.filter), information(changed);
  Estimate a, b;
  SimulatedWorld world = point_world(scene.vehicles, 5);
  SensorSet sensors = point_sensors(scene.vehicles, {scene.place, true}, 5);
  FixedRateClock clock(10, 30);
  Command command;
  for (const SteeringSettings& steer : scene.steering) command.bodies.push_back({steer.most_input * 0.3});
  // The square root of a covariance in the unscented transform amplifies rounding where two directions are
  // nearly alike
  const double tolerance = linearization == Linearization::unscented_vehicle ? 1e-6 : 1e-8;
  std::size_t first_seen = 0;
  while (const Tick tick = clock.next()) {
    const Observation observation = sensors.measure(world.move(command, tick), tick);
    covariance.update(a, command, observation, tick);
    information.update(b, command, observation, tick);
    if (tick.frame == 0) first_seen = a.landmarks.size();
    ASSERT_EQ(a.last.matched, b.last.matched) << tick.frame;
    ASSERT_NEAR(a.last.update.nis, b.last.update.nis, tolerance * (1 + a.last.update.nis)) << tick.frame;
    ASSERT_LT(apart(a.belief, b.belief, blocks_of(a)), tolerance) << tick.frame;
    ASSERT_NEAR(a.entropy.total, b.entropy.total, 1e-6);
    ASSERT_NEAR(a.entropy.map, b.entropy.map, 1e-6);
    ASSERT_NEAR(a.entropy.vehicle, b.entropy.vehicle, 1e-6);
  }
  EXPECT_EQ(a.status.state, TrackingState::tracking);
  EXPECT_EQ(b.status.state, TrackingState::tracking);
  if (known_map)
    EXPECT_EQ(a.belief.errors(), 9);
  else
    EXPECT_GT(a.landmarks.size(), first_seen) << "initialized during the run";
}

INSTANTIATE_TEST_SUITE_P(
    All, Forms,
    ::testing::Combine(::testing::Values(Linearization::analytic, Linearization::iterated,
                                         Linearization::unscented_vehicle, Linearization::first_estimate),
                       ::testing::Bool()));

TEST(Forms, InformationFormRefusesExactPriors) {
  const AnyMotion motion = motion_named("differential-drive");
  EstimatorSettings settings =
      scene_of(motion, BearingSensor{}, Linearization::analytic, BeliefForm::information).filter;
  EXPECT_EQ(validate(settings), "");
  settings.filter.sigma_inverse_depth_per_m = 0;
  EXPECT_NE(validate(settings).find("inverse depth that is known exactly"), std::string::npos);
  settings.filter.sigma_inverse_depth_per_m = 0.25;
  settings.bodies[0].start_sigmas[2] = 0;
  EXPECT_NE(validate(settings).find("start that is known exactly"), std::string::npos);
  EXPECT_THROW(SlamEstimator{settings}, std::invalid_argument);
  settings.filter.form = BeliefForm::covariance;
  EXPECT_EQ(validate(settings), "");
}

/// Vehicles whose paths cross at small distances stay consistent.
TEST(Team, IsConsistentWhereVehiclesMeet) {
  double nees = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scene scene = three_on_circles(true, 20, 0.01);
    for (SteeringSettings& steer : scene.steering) std::get<CirclePath>(steer.path).center.setZero();
    nees += run(scene, 60, seed).nees / 5;
  }
  EXPECT_LT(nees, 2);
}

TEST(Team, AWrongStartIsReportedAsLost) {
  Scene scene = three_on_circles(false, 20, 0.01);
  for (BodyModel& member : scene.filter.bodies) member.start[2] += 2;  // confident of a wrong heading
  scene.filter.anchors = scene.place;
  scene.filter.filter.gate_probability = 0.99;
  const Result result = run(scene, 20, 1);
  EXPECT_EQ(result.estimate.status.state, TrackingState::lost);
  EXPECT_NE(result.estimate.status.reason.find("no detection matches a landmark"), std::string::npos)
      << result.estimate.status.reason;
}

TEST(Team, ALostBodyBrakes) {
  const AnyMotion body = motion_named("free-camera");
  const Scene scene = scene_of(body, sensor_named("stereo", body), Linearization::analytic);
  SteeringController controller({{body, scene.steering[0]}}, 0.05);
  Estimate e;
  SlamEstimator estimator(scene.filter);
  Observation nothing;
  nothing.bodies.resize(1);
  estimator.update(e, {}, nothing, {0, 0, 0});
  e.bodies[0].state.segment<3>(7) << 0.4, 0, -0.2;
  controller.act(e, {}, {}, {1, 0.05, 0.05});
  e.bodies[0].status.state = TrackingState::lost;
  const Command braking = controller.act(e, {}, {}, {2, 0.1, 0.05});
  ASSERT_EQ(braking.bodies.size(), 1u);
  EXPECT_NEAR(braking.bodies[0].input[0], -0.8, 1e-12);
  EXPECT_NEAR(braking.bodies[0].input[2], 0.4, 1e-12);
  EXPECT_TRUE(controller.act(e, {}, {}, {30, 1.5, 0.05}).bodies[0].input.isZero()) << "then nothing";
}

TEST(Team, IsDeterministicForASeed) {
  const AnyMotion motion = motion_named("differential-drive");
  const Scene scene = scene_of(motion, sensor_named("range-bearing", motion), Linearization::analytic);
  const Result a = run(scene, 10, 3), b = run(scene, 10, 3), c = run(scene, 10, 4);
  EXPECT_EQ(a.estimate.belief.dense_covariance(), b.estimate.belief.dense_covariance());
  EXPECT_NE(a.nees, c.nees);
}

TEST(Team, RefusesInvalidSettings) {
  const AnyMotion motion = motion_named("differential-drive");
  Scene scene = scene_of(motion, sensor_named("range-bearing", motion), Linearization::analytic);
  const auto refused = [](const EstimatorSettings& settings, const char* because) {
    const std::string problem = validate(settings);
    EXPECT_NE(problem.find(because), std::string::npos) << problem;
  };
  EstimatorSettings changed = scene.filter;
  changed.bodies[0].sensors[0].sigmas = vec({0.1});
  refused(changed, "2 finite numbers");
  changed = scene.filter;
  changed.bodies[0].sensors[0].sigmas = vec({0.1, 0});
  refused(changed, "more than 0");
  changed = scene.filter;
  changed.anchors[3] = vec({1, 2, 3});
  refused(changed, "anchor 3");
  const AnyMotion body = motion_named("free-camera");
  changed = scene_of(body, sensor_named("stereo", body), Linearization::iterated).filter;
  EXPECT_EQ(validate(changed), "");
  changed.filter.max_linearity_index = 0.1;
  refused(changed, "turns a map that no anchor fixes");
  changed.anchors[1] = vec({1, 2, 3});
  EXPECT_EQ(validate(changed), "");
  changed = scene.filter;
  changed.bodies.clear();
  refused(changed, "needs a vehicle");
}

std::string why_not(const AnyMotion& motion, const SteeringSettings& steer, double period_s) {
  try {
    make_steering(motion, steer, period_s);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Steering, RefusesInvalidSettings) {
  const AnyMotion on_axle = DifferentialDrive{0, 0}, drive = DifferentialDrive{0.3, 0},
                  car = motion_named("ackermann");
  SteeringSettings s;
  s.most_input = vec({1, 1});
  s.path = PointPath{{10, 10, 0}};
  s.law = ControlLaw::feedback_linearization;
  EXPECT_EQ(why_not(drive, s, 0.1), "");
  EXPECT_NE(why_not(on_axle, s, 0.1), "");
  s.gain_per_s = {25};
  EXPECT_NE(why_not(drive, s, 0.1), "");
  s.gain_per_s = {0.5};
  s.most_input = vec({1});
  EXPECT_NE(why_not(drive, s, 0.1).find("2 numbers"), std::string::npos);
  s.most_input = vec({0.1, 1});
  s.path = CirclePath{};
  EXPECT_NE(why_not(drive, s, 0.1), "") << "the path needs 0.6 m/s, the limit is 0.1 m/s";
  s.most_input = vec({1, 1});
  s.law = ControlLaw::lqg;
  EXPECT_NE(why_not(drive, s, 0.1).find("to a point"), std::string::npos);
  EXPECT_NE(why_not(car, s, 0.1), "");
  s.law = ControlLaw::none;
  s.input = vec({0.1});
  EXPECT_NE(why_not(drive, s, 0.1).find("2 numbers"), std::string::npos);
}

}  // namespace
}  // namespace incognita
