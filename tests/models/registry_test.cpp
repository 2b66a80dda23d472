// What registered models declare about themselves is complete, unambiguous and correct.
#include "incognita/models/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <variant>

#include "tests/models/registered.hpp"
#include "tests/models/sensor_cases.hpp"

namespace incognita {
namespace {

using sensor_cases::differences;
using sensor_cases::expect_jacobian;
using testing::minus;
using testing::vec;

template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(none)";
}

void expect_distinct_keys(std::span<const Quantity> quantities, std::string_view of) {
  std::set<std::string> keys;
  for (const Quantity& quantity : quantities) {
    EXPECT_FALSE(quantity.name.empty()) << of;
    EXPECT_TRUE(keys.insert(quantity.key()).second) << of << ": " << quantity.key() << " twice";
  }
}

void expect_sound(const std::vector<ParameterInfo>& parameters, std::string_view of) {
  std::set<std::string> keys;
  for (const ParameterInfo& p : parameters) {
    EXPECT_TRUE(keys.insert(p.quantity.key()).second) << of << ": " << p.quantity.key() << " twice";
    EXPECT_TRUE(p.range.contains(p.default_value)) << of << ": default of " << p.quantity.key();
    EXPECT_GT(p.help.size(), 5u) << of << ": " << p.quantity.key();
  }
}

TEST(Registry, NamesAreUniqueAndEveryComponentHasOne) {
  std::set<std::string_view> motions, sensors;
  for (const auto& [traits, parameters] : registered_motions()) {
    EXPECT_TRUE(motions.insert(traits.name).second) << traits.name;
    EXPECT_GT(traits.summary.size(), 10u) << traits.name;
    expect_distinct_keys(traits.state, traits.name);
    expect_distinct_keys(traits.error, traits.name);
    expect_distinct_keys(traits.input, traits.name);
    expect_sound(parameters, traits.name);
  }
  for (const auto& [traits, parameters] : registered_sensors()) {
    EXPECT_TRUE(sensors.insert(traits.name).second) << traits.name;
    EXPECT_GT(traits.summary.size(), 10u) << traits.name;
    expect_distinct_keys(traits.measurement, traits.name);
    expect_sound(parameters, traits.name);
  }
}

TEST(Registry, NamesMakeModelsAndUnknownNamesSuggestTheNearest) {
  for (const std::string& name : motion_names()) EXPECT_EQ(traits_of(make_motion(name)).name, name);
  EXPECT_NE(refusal([] { make_motion("ackerman"); }).find("`ackermann`"), std::string::npos);
  for (const auto& [motion, unused] : registered_motions())
    for (const std::string& word : sensor_words()) {
      const AnySensor sensor = make_sensor(word, motion);
      EXPECT_EQ(traits_of(sensor).word, word);
      bool any_fits = false;
      for (const AnySensor& other : registered::sensors())
        any_fits |= traits_of(other).word == word && incompatibility(make_motion(motion.name), other).empty();
      EXPECT_EQ(incompatibility(make_motion(motion.name), sensor).empty(), any_fits)
          << motion.name << ", " << word;
    }
  EXPECT_NE(refusal([] { make_sensor("sterio", traits_of(FreeCameraMotion{})); }).find("`stereo`"),
            std::string::npos);
  EXPECT_TRUE(std::holds_alternative<RelativePositionSensor>(
      make_sensor("range-bearing", traits_of(MonobotMotion{}))));
  EXPECT_TRUE(std::holds_alternative<RangeBearingSensor>(
      make_sensor("range-bearing", traits_of(FreeCameraMotion{}))));
}

TEST(Registry, EveryVehicleHasASensorAndEverySensorAVehicle) {
  const std::vector<AnyMotion> motions = registered::motions();
  const std::vector<AnySensor> sensors = registered::sensors();
  for (const AnyMotion& motion : motions)
    EXPECT_TRUE(std::any_of(sensors.begin(), sensors.end(), [&](const auto& s) {
      return incompatibility(motion, s).empty();
    })) << traits_of(motion).name;
  for (const AnySensor& sensor : sensors)
    EXPECT_TRUE(std::any_of(motions.begin(), motions.end(), [&](const auto& m) {
      return incompatibility(m, sensor).empty();
    })) << traits_of(sensor).name;
}

TEST(Registry, ParametersAreSetByTheirKeys) {
  const auto check = [](auto model, std::string_view name) {
    using Model = decltype(model);
    set_parameters(model, [](const std::string&, double usual) { return usual + 0.25; });
    Model plain;
    std::set<const double*> places;
    for (const Parameter<Model>& p : parameters_of<Model>()) {
      EXPECT_EQ(p.in(model), p.in(plain) + 0.25) << name << ": " << p.quantity.key();
      EXPECT_TRUE(places.insert(&p.in(model)).second) << name << ": two parameters refer to the same member";
    }
  };
  for_each_type<AnyMotion>([&]<class M>(std::type_identity<M>) { check(M{}, M::name); });
  for_each_type<AnySensor>([&]<class S>(std::type_identity<S>) { check(S{}, S::name); });
}

TEST(Registry, StateAtRestKeepsThePoseAndStaysThere) {
  const Eigen::Vector3d position(1.5, -2, 0.7);
  for (const AnyMotion& motion : registered::motions())
    for (const double heading : {0.0, 2.5, -3.0}) {
      const MotionTraits& traits = traits_of(motion);
      const SmallVector x = at_rest(motion, position, heading);
      EXPECT_LE((x.head(traits.position_size) - position.head(traits.position_size)).norm(), 1e-15)
          << traits.name;
      if (!traits.on_line()) {
        EXPECT_NEAR(heading_by(motion, x), heading, 1e-12) << traits.name;
      }
      EXPECT_EQ(rate_of(motion, x, SmallVector::Zero(inputs_of(motion))).norm(), 0) << traits.name;
    }
}

TEST(Registry, HeadingIsThatOfThePose) {
  for (const AnyMotion& motion : registered::motions())
    for (const SmallVector& x : registered::states(motion)) {
      const Eigen::Matrix3d axes = rotation_matrix<double>(pose_of(motion, x).world_from_body);
      const Eigen::Vector3d ahead = axes.col(traits_of(motion).in_space() ? 2 : 0);
      const double heading = std::atan2(ahead.y(), ahead.x());
      EXPECT_NEAR(wrap_angle(heading_by(motion, x) - heading), 0, 1e-9) << traits_of(motion).name;
    }
}

TEST(Registry, PoseJacobiansEqualDifferences) {
  const Chart pose_chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};
  for (const AnyMotion& motion : registered::motions())
    for (const SmallVector& x : registered::states(motion))
      expect_jacobian(pose_jacobian(motion, x),
                      differences(
                          chart_of(motion), x, pose_chart,
                          [&](const SmallVector& at) -> SmallVector {
                            const RigidPose pose = pose_of(motion, at);
                            SmallVector numbers(7);
                            numbers << pose.position, pose.world_from_body;
                            return numbers;
                          },
                          1e-4),
                      std::string(traits_of(motion).name));
}

/// The motion of rate() by many classical Runge-Kutta steps.
SmallVector integrated(const AnyMotion& motion, SmallVector x, const SmallVector& u, double dt) {
  constexpr int steps = 64;
  const double h = dt / steps;
  const auto rate = [&](const SmallVector& at) { return rate_of(motion, at, u); };
  for (int i = 0; i < steps; ++i) {
    const SmallVector a = rate(x), b = rate(x + h / 2 * a), c = rate(x + h / 2 * b), d = rate(x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return x;
}

/// A filter that steps along the tangent has an error to the same side at every step. The error of
/// integrators is of third order at most.
TEST(Registry, IntegratorsFollowAConstantInput) {
  RandomStream random(1, "inputs");
  for (const AnyMotion& motion : registered::motions())
    for (const SmallVector& x : registered::states(motion))
      for (const double dt : {0.2, 0.02}) {
        SmallVector u(inputs_of(motion));
        for (double& number : u) number = random.uniform(-0.5, 0.5);
        const SmallVector stepped = std::visit(
            [&](const auto& model) -> SmallVector {
              using Model = std::decay_t<decltype(model)>;
              return integrator_of(model)
                  .step(typename Model::template State<double>(x), typename Model::template Input<double>(u),
                        dt)
                  .x;
            },
            motion);
        const double speed = 1 + rate_of(motion, x, u).norm() + u.norm();
        const double missed = minus(chart_of(motion), stepped, integrated(motion, x, u, dt)).norm();
        EXPECT_LE(missed, 0.2 * std::pow(dt * speed, 3) + 1e-12)
            << traits_of(motion).name << " dt " << dt << " x " << x.transpose() << " u " << u.transpose();
      }
}

TEST(Quantity, KeysEndWithTheUnit) {
  EXPECT_EQ((Quantity{"speed", "m/s"}.key()), "speed_m_s");
  EXPECT_EQ((Quantity{"ax", "m/s^2", "acceleration"}.key()), "ax_m_s2");
  EXPECT_EQ((Quantity{"ax", "m/s^2", "acceleration"}.kind_key()), "acceleration_m_s2");
  EXPECT_EQ((Quantity{"inverse_depth", "1/m"}.key()), "inverse_depth_per_m");
  EXPECT_EQ((Quantity{"slope", ""}.key()), "slope");
}

TEST(Quantity, ValuesAreFoundByKindAndMissingOnesAreNamed) {
  const std::array<Quantity, 3> quantities{
      {{"x", "m", "position"}, {"y", "m", "position"}, {"heading", "rad"}}};
  EXPECT_EQ(values_of(quantities, {{"heading_rad", 3}, {"position_m", 2}}), vec({2, 2, 3}));
  EXPECT_NE(refusal([&] {
              values_of(quantities, {{"position_m", 2}});
            }).find("`heading_rad`"),
            std::string::npos);
}

}  // namespace
}  // namespace incognita
