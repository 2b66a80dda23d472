// Every steering law drives every vehicle that it supports to its path, on the continuous plant and within
// its limits; unsupported vehicles and invalid numbers are refused with the reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "incognita/control/steering.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/world/plant.hpp"
#include "tests/scratch.hpp"
#include "tests/small_vectors.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::minus;
using testing::vec;

Path circle(double rate_rad_s = 0.12) {
  return CirclePath{.center = {1, 2, 0}, .radius_m = 4, .rate_rad_s = rate_rad_s, .phase_rad = 1};
}
Path point() { return PointPath{.position = {3, 2, 1}, .heading_rad = 0.5}; }
Path way_points() { return WayPointPath{{{0, 0, 0}, {6, 0, 0}, {6, 5, 0}, {-2, 7, 0}}, 0.5}; }
Path swing(double radius_m, double amplitude_rad = 0.2) {
  return BackAndForthPath{.center = {0, 0, 1.2}, .radius_m = radius_m, .amplitude_rad = amplitude_rad};
}
/// A slow figure of eight with changing height, heading along the path.
Path eight(double size = 1) {
  PathSamples samples;
  for (int i = 0; i <= 80; ++i) {
    samples.t.push_back(2 * i);
    samples.position.emplace_back(size * 5 * std::sin(0.1 * i), size * 3 * std::sin(0.2 * i),
                                  1 + 0.8 * std::sin(0.15 * i));
  }
  return through(samples);
}

const AnyMotion line = MonobotMotion{}, drive = DifferentialDrive{0.3, 0.1},
                car = AckermannCar{1.0, 0.3, {0.8, 0}}, body = FreeCameraMotion{},
                terrain = TerrainVehicle{Waves{0, {{0.15, 6, 0.3, 0}, {0.1, 4, 1.7, 1}}}};
constexpr double before_axle_m = 0.2;  // on uneven ground

struct Case {
  const AnyMotion& motion;
  ControlLaw law;
  Path path;
  double bound_m;         ///< final distance to the path
  double bound_rad = -1;  ///< final error of heading or gaze; negative where the law leaves it free
  double duration_s = 60;
  double period_s = 0.1;
};

constexpr double still = 1e-6;  // m, for paths that end at rest or consist of arcs, as held commands do

/// Elsewhere a command is held while the reference changes: with a = 0.12^2 4 m/s^2 the error is a period /
/// (2 K), 6 mm on the line; the other bounds follow in the same way.
std::vector<Case> on_the_line() {
  std::vector<Case> all{{line, ControlLaw::lqg, point(), still}};
  for (const ControlLaw law : {ControlLaw::tracking, ControlLaw::feedback_linearization})
    for (const auto& [path, bound_m] : std::initializer_list<std::pair<Path, double>>{
             {point(), still}, {circle(), 0.006}, {eight(), 0.006}, {way_points(), 0.015}, {swing(1), 0.08}})
      all.push_back({line, law, path, bound_m});
  return all;
}

std::vector<Case> on_the_plane() {
  std::vector<Case> all{{drive, ControlLaw::lqg, point(), still},
                        {drive, ControlLaw::tracking, circle(), still, still},
                        {drive, ControlLaw::tracking, circle(-0.12), still, still},
                        {drive, ControlLaw::tracking, eight(), 0.005, 0.01},
                        {drive, ControlLaw::tracking, way_points(), 1e-3, 1e-3, 110}};  // after its end
  for (const AnyMotion* motion : {&drive, &car}) {
    const ControlLaw law = ControlLaw::feedback_linearization;
    all.push_back({*motion, law, point(), still});
    all.push_back({*motion, law, circle(), 1e-5});
    all.push_back({*motion, law, circle(-0.12), 1e-5});
    // a path within the turning radius of a car
    all.push_back({*motion, law, eight(motion == &car ? 2 : 1), 0.005});
    all.push_back({*motion, law, way_points(), 1e-5, -1, 110});
    all.push_back({*motion, law, swing(4, 0.05), 0.03});
  }
  return all;
}

/// The laws assume level ground: a slope of 0.3 costs 4 per cent of the speed, 2 cm/s.
std::vector<Case> on_uneven_ground() {
  return {{terrain, ControlLaw::tracking, circle(), 0.02, 0.03},
          {terrain, ControlLaw::tracking, eight(), 0.02, 0.03},
          {terrain, ControlLaw::tracking, way_points(), 0.01, 0.03, 110},
          {terrain, ControlLaw::feedback_linearization, point(), still},
          {terrain, ControlLaw::feedback_linearization, circle(), 0.02},
          {terrain, ControlLaw::feedback_linearization, eight(), 0.02},
          {terrain, ControlLaw::feedback_linearization, way_points(), 1e-5, -1, 110}};
}

/// A command held while the acceleration changes by the jerk j leaves j period / (2 K_p): 1 cm at the
/// greatest, 3 m/s^3.
std::vector<Case> in_space() {
  std::vector<Case> all{{body, ControlLaw::lqg, PointPath{{1, 1, 1}, 2}, still, still, 40, 0.05}};
  for (const ControlLaw law : {ControlLaw::tracking, ControlLaw::feedback_linearization}) {
    all.push_back({body, law, PointPath{{1, 1, 1}, 2}, still, still, 30, 0.05});
    all.push_back({body, law, circle(), 1e-4, 1e-4, 30, 0.05});
    all.push_back({body, law, eight(), 1e-4, 1e-4, 30, 0.05});
    all.push_back({body, law, way_points(), 1e-3, 1e-4, 20, 0.05});  // in the middle of a segment
    all.push_back({body, law, swing(1.5), 0.01, 0.01, 30, 0.05});
  }
  return all;
}

SteeringSettings settings_of(const AnyMotion& motion, ControlLaw law, const Path& path) {
  SteeringSettings s;
  s.law = law;
  s.path = path;
  s.control_point_m = before_axle_m;
  const int inputs = inputs_of(motion);
  s.most_input = inputs == 1 ? vec({1.5}) : inputs == 2 ? vec({1.5, 1}) : SmallVector::Constant(6, 3);
  if (&motion == &car) s.most_input[1] = 0.6;
  return s;
}

/// Starts off the path, with a wrong heading.
std::vector<SmallVector> starts_of(const AnyMotion& motion) {
  if (&motion == &line) return {vec({-8}), vec({0}), vec({15})};
  if (&motion != &body) return {vec({0, 0, 0}), vec({6, -3, 3.1}), vec({-4, 5, -2}), vec({3, 2, 1.5})};
  std::vector<SmallVector> all;
  RandomStream random(1, "starts");
  for (int i = 0; i < 4; ++i) {
    SmallVector x(13);
    for (double& number : x) number = random.uniform(-1, 1);
    x.segment<4>(3).normalize();
    if (i == 0) x.tail<6>().setZero();
    all.push_back(x);
  }
  return all;
}

/// Distance of the steered point from its reference, and error of the heading or gaze.
struct Off {
  double m = 0, rad = 0;
};

Off off(const Case& c, const SmallVector& x, const Reference& r) {
  if (&c.motion == &line) return {std::abs(x[0] - r.position.x()), 0};
  if (&c.motion == &body) {
    SmallVector desired = x;
    desired.segment<4>(3) = level_gaze(r.heading);
    return {(x.head<3>() - r.position).norm(), minus(chart_of(c.motion), x, desired).segment<3>(3).norm()};
  }
  // Tracking steers the axle, the other laws a point off the axle
  const bool tracks = steers_axle(c.law);
  Eigen::Vector2d from_state(0, 0);
  if (&c.motion == &drive && tracks) from_state << -0.3, -0.1;
  if (&c.motion == &terrain && !tracks) from_state << before_axle_m, 0;
  const Eigen::Vector2d at = x.head<2>() + Eigen::Rotation2Dd(x[2]) * from_state;
  return {(at - r.position.head<2>()).norm(), std::abs(wrap_angle(x[2] - r.heading))};
}

/// The greatest error in the last fifth of the time.
Off driven(const Case& c, const SmallVector& start) {
  const SteeringSettings s = settings_of(c.motion, c.law, c.path);
  const auto law = make_steering(c.motion, s, c.period_s);
  const int inputs = inputs_of(c.motion), ticks = static_cast<int>(c.duration_s / c.period_s);
  Plant plant(c.motion,
              {start, SmallVector::Zero(chart_of(c.motion).tangent()), SmallVector::Zero(inputs),
               -s.most_input, s.most_input},
              1, "plant");
  Off worst;
  for (int k = 0; k < ticks; ++k) {
    const double t = k * c.period_s;
    const Off now = off(c, plant.state(), at(s.path, t));
    if (t > 0.8 * c.duration_s) worst = {std::max(worst.m, now.m), std::max(worst.rad, now.rad)};
    const SmallVector input = law->act(plant.state(), t);
    plant.move(input, c.period_s);
    EXPECT_EQ(plant.executed(), input) << "beyond its limit, at t = " << t;
  }
  return worst;
}

void expect_convergence(const std::vector<Case>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const SmallVector& start : starts_of(cases[i].motion)) {
      const Off worst = driven(cases[i], start);
      SCOPED_TRACE("law " + std::to_string(static_cast<int>(cases[i].law)) + ", case " + std::to_string(i) +
                   ", from " + std::to_string(start[0]));
      EXPECT_LE(worst.m, cases[i].bound_m);
      if (cases[i].bound_rad >= 0) {
        EXPECT_LE(worst.rad, cases[i].bound_rad);
      }
    }
}

TEST(SteeringLaws, ConvergeOnALine) { expect_convergence(on_the_line()); }
TEST(SteeringLaws, ConvergeOnThePlane) { expect_convergence(on_the_plane()); }
TEST(SteeringLaws, ConvergeOnUnevenGround) { expect_convergence(on_uneven_ground()); }
TEST(SteeringLaws, ConvergeInSpace) { expect_convergence(in_space()); }

TEST(SteeringLaws, HoldAConstantInput) {
  for (const AnyMotion* motion : {&line, &drive, &car, &terrain, &body}) {
    SteeringSettings s;
    s.input = SmallVector::LinSpaced(inputs_of(*motion), -0.3, 0.5);
    const auto law = make_steering(*motion, s, 0.1);
    for (const double t : {0.0, 1.0, 1e6})
      for (const SmallVector& state : starts_of(*motion)) EXPECT_EQ(law->act(state, t), s.input);
  }
}

TEST(SteeringLaws, RespectLimitsBelowTheLawsOwn) {
  SteeringSettings s = settings_of(body, ControlLaw::feedback_linearization, point());
  s.most_input = vec({0.5, 1, 2, 0.1, 0.2, 0.3});
  for (const ControlLaw law : {ControlLaw::feedback_linearization, ControlLaw::lqg}) {
    s.law = law;
    const SmallVector far = vec({50, -60, 70, 0, 0, 1, 0, 0, 0, 0, 9, -9, 9});
    const SmallVector u = make_steering(body, s, 0.05)->act(far, 0);
    EXPECT_EQ(u.cwiseAbs(), s.most_input) << "up to its limit";
  }
}

// Refusals

std::string why_not(const AnyMotion& motion, const SteeringSettings& s, double period_s = 0.1) {
  return message_of<std::invalid_argument>([&] { make_steering(motion, s, period_s); });
}

std::string why_not(const AnyMotion& motion, ControlLaw law, const Path& path,
                    const std::function<void(SteeringSettings&)>& change = {}) {
  SteeringSettings s = settings_of(motion, law, path);
  if (change) change(s);
  return why_not(motion, s);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();

TEST(SteeringRefusals, AnUnsupportedMotionModel) {
  EXPECT_HAS(why_not(car, ControlLaw::tracking, circle()), "a car is steered by `feedback-linearization`");
  EXPECT_HAS(why_not(car, ControlLaw::lqg, point()), "a car is steered by `feedback-linearization`");
  EXPECT_HAS(why_not(terrain, ControlLaw::lqg, point()), "does not know the slopes");
}

TEST(SteeringRefusals, AnUnsupportedPath) {
  for (const AnyMotion* motion : {&line, &drive, &body})
    for (const Path& path : {circle(), way_points(), eight(), swing(1)})
      EXPECT_HAS(why_not(*motion, ControlLaw::lqg, path), "an LQG regulator drives to a point");
  for (const AnyMotion* motion : {&drive, &terrain}) {
    EXPECT_HAS(why_not(*motion, ControlLaw::tracking, point()), "a reference that moves");
    EXPECT_HAS(why_not(*motion, ControlLaw::tracking, WayPointPath{{{1, 2, 0}}, 0.5}),
               "a reference that moves");
    EXPECT_HAS(why_not(*motion, ControlLaw::tracking, swing(1)), "not where it goes");
    PathSamples sideways{{0, 1, 2}, {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}, {1.5, 1.5, 1.5}};
    EXPECT_HAS(why_not(*motion, ControlLaw::tracking, through(sideways)),
               "the path faces 1.5 rad away from where it goes");
  }
}

TEST(SteeringRefusals, AnInvalidPath) {
  for (const AnyMotion* motion : {&line, &drive, &car, &terrain, &body}) {
    EXPECT_HAS(why_not(*motion, ControlLaw::feedback_linearization, CirclePath{.radius_m = -1}), "radius");
    EXPECT_HAS(why_not(*motion, ControlLaw::feedback_linearization, PointPath{{nan, 0, 0}}), "not finite");
    EXPECT_HAS(why_not(*motion, ControlLaw::feedback_linearization, WayPointPath{}), "no way-points");
  }
}

TEST(SteeringRefusals, APathThatIsTooFast) {
  const Path fast = CirclePath{.radius_m = 4, .rate_rad_s = 0.5};  // 2 m/s
  for (const AnyMotion* motion : {&line, &drive, &car, &terrain})
    EXPECT_HAS(why_not(*motion, ControlLaw::feedback_linearization, fast),
               "the path asks for 2 m/s at t = 0 s");
  for (const AnyMotion* motion : {&drive, &terrain}) {
    EXPECT_HAS(why_not(*motion, ControlLaw::tracking, fast), "the path asks for 2 m/s");
    const Path tight = CirclePath{.radius_m = 0.5, .rate_rad_s = -1.5};
    for (const ControlLaw law : {ControlLaw::tracking, ControlLaw::feedback_linearization})
      EXPECT_HAS(why_not(*motion, law, tight), "the circle turns with 1.5 rad/s, the vehicle with at most 1");
  }
  EXPECT_HAS(why_not(car, ControlLaw::feedback_linearization, CirclePath{.radius_m = 1.6, .rate_rad_s = 0.1}),
             "the circle's radius is 1.6 m, and the car's steering allows 1.66");
  const Path jerky = CirclePath{.radius_m = 1, .rate_rad_s = 2};  // 4 m/s^2
  for (const ControlLaw law : {ControlLaw::tracking, ControlLaw::feedback_linearization}) {
    EXPECT_HAS(why_not(body, law, jerky), "the path asks for 4 m/s^2, the body has 3 m/s^2");
    const Path turning = BackAndForthPath{.radius_m = 0.1, .amplitude_rad = 1};
    EXPECT_HAS(why_not(body, law, turning), "the gaze asks for 4 rad/s^2, the body has 3 rad/s^2");
  }
}

/// A car follows the tightest circle that is not refused; a tighter one is refused.
TEST(SteeringRefusals, ACircleTighterThanTheTurningRadius) {
  const AckermannCar& its = std::get<AckermannCar>(car);
  const double tightest = std::hypot(its.wheelbase_m / std::tan(0.6), its.body.forward_m);
  const auto around = [](double radius_m) { return CirclePath{.radius_m = radius_m, .rate_rad_s = 0.2}; };
  EXPECT_HAS(why_not(car, ControlLaw::feedback_linearization, around(0.999 * tightest)), "steering allows");
  const Case wide{car, ControlLaw::feedback_linearization, around(1.001 * tightest), 1e-4};
  EXPECT_LE(driven(wide, vec({0, 0, 0})).m, wide.bound_m);
}

TEST(SteeringRefusals, AControlPointOnTheAxle) {
  EXPECT_HAS(
      why_not(DifferentialDrive{0, 0.1}, settings_of(drive, ControlLaw::feedback_linearization, point())),
      "must be before or behind the axle");
  EXPECT_NE(why_not(DifferentialDrive{0, 0.1}, settings_of(drive, ControlLaw::lqg, point())), "(none)");
  EXPECT_HAS(
      why_not(AckermannCar{1, 0.3, {0, 0}}, settings_of(car, ControlLaw::feedback_linearization, point())),
      "must be before or behind the axle");
  for (const double bad : {0.0, nan, inf})
    EXPECT_HAS(why_not(terrain, ControlLaw::feedback_linearization, point(),
                       [&](auto& s) { s.control_point_m = bad; }),
               "before or behind the axle");
  for (const ControlLaw law : {ControlLaw::tracking, ControlLaw::feedback_linearization, ControlLaw::lqg})
    EXPECT_HAS(why_not(DifferentialDrive{nan, 0}, settings_of(drive, law, point())),
               "finite distance from the axle");
}

TEST(SteeringRefusals, InvalidLimits) {
  for (const AnyMotion* motion : {&line, &drive, &car, &terrain, &body}) {
    const int inputs = inputs_of(*motion);
    const auto with = [&](const SmallVector& most) {
      return why_not(*motion, ControlLaw::feedback_linearization, circle(),
                     [&](auto& s) { s.most_input = most; });
    };
    EXPECT_HAS(with(SmallVector::Constant(inputs + 1, 2)), "need " + std::to_string(inputs) + " numbers");
    EXPECT_HAS(with(SmallVector(0)), "need " + std::to_string(inputs) + " numbers, and have 0");
    for (const double bad : {0.0, -1.0})
      EXPECT_HAS(with(SmallVector::Constant(inputs, bad)), "must be positive");
    for (const double bad : {nan, inf})
      EXPECT_HAS(with(SmallVector::Constant(inputs, bad)), "must be finite");
  }
  EXPECT_HAS(
      why_not(car, ControlLaw::feedback_linearization, point(), [](auto& s) { s.most_input[1] = 1.6; }),
      "between 0 and pi/2");
}

TEST(SteeringRefusals, AnInvalidPeriod) {
  for (const AnyMotion* motion : {&line, &drive, &car, &terrain, &body})
    for (const ControlLaw law :
         {ControlLaw::none, ControlLaw::tracking, ControlLaw::lqg, ControlLaw::feedback_linearization})
      for (const double bad : {0.0, -0.1, nan, inf}) {
        SteeringSettings s = settings_of(*motion, law, circle());
        s.input = s.most_input;
        EXPECT_HAS(why_not(*motion, s, bad), "must be positive and finite");
      }
}

TEST(SteeringRefusals, AConstantInputBeyondTheLimits) {
  SteeringSettings s;
  EXPECT_HAS(why_not(drive, s), "the inputs that are held need 2 numbers, and have 0");
  s.input = vec({0.1, nan});
  EXPECT_HAS(why_not(drive, s), "must be finite");
  s.input = vec({0.1, 2});
  EXPECT_EQ(why_not(drive, s), "(none)") << "without limits";
  s.most_input = vec({1, 1});
  EXPECT_HAS(why_not(drive, s), "exceeds what the vehicle can do");
}

/// The keys of a law's gains, and a path for it.
struct Gain {
  const AnyMotion& motion;
  ControlLaw law;
  Path path;
  std::vector<double*> of(SteeringSettings& s) const {
    if (law == ControlLaw::lqg) return {s.weight_state.data(), s.weight_input.data()};
    if (&motion == &body)
      return {&s.camera.gain_position_per_s2, &s.camera.gain_velocity_per_s,
              &s.camera.gain_orientation_per_s2, &s.camera.gain_rate_per_s};
    if (law == ControlLaw::tracking && &motion != &line)
      return {&s.gain_along_per_s, &s.gain_across_per_m2, &s.gain_heading_per_m};
    return {s.gain_per_s.data()};
  }
};

std::vector<Gain> gains() {
  std::vector<Gain> all{{line, ControlLaw::lqg, point()},
                        {drive, ControlLaw::lqg, point()},
                        {body, ControlLaw::lqg, point()},
                        {terrain, ControlLaw::tracking, circle()}};
  for (const AnyMotion* motion : {&line, &drive, &body})
    all.push_back({*motion, ControlLaw::tracking, circle()});
  for (const AnyMotion* motion : {&line, &drive, &car, &terrain, &body})
    all.push_back({*motion, ControlLaw::feedback_linearization, circle()});
  return all;
}

TEST(SteeringRefusals, GainsThatAreNotPositive) {
  for (const Gain& gain : gains()) {
    SteeringSettings s = settings_of(gain.motion, gain.law, gain.path);
    EXPECT_EQ(why_not(gain.motion, s), "(none)");
    for (double* number : gain.of(s))
      for (const double bad : {0.0, -1.0, nan, inf}) {
        const double good = std::exchange(*number, bad);
        EXPECT_GT(why_not(gain.motion, s).size(), 20u) << static_cast<int>(gain.law) << ": accepts " << bad;
        *number = good;
      }
  }
}

TEST(SteeringRefusals, GainsOfTheWrongSize) {
  for (const Gain& gain : gains()) {
    SteeringSettings s = settings_of(gain.motion, gain.law, gain.path);
    if (gain.law == ControlLaw::tracking && &gain.motion != &line) continue;  // its gains are scalars
    if (gain.law == ControlLaw::feedback_linearization && &gain.motion == &body) continue;
    (gain.law == ControlLaw::lqg ? s.weight_state : s.gain_per_s) = std::vector<double>(5, 1.0);
    EXPECT_HAS(why_not(gain.motion, s), "needs 1 number or ") << static_cast<int>(gain.law);
  }
}

TEST(SteeringLaws, WeightEachInputSeparately) {
  SteeringSettings s = settings_of(drive, ControlLaw::lqg, point());
  const SmallVector x = vec({-3, 0.4, 0.1});
  const SmallVector even = make_steering(drive, s, 0.1)->act(x, 0);
  s.weight_input = {1, 1e4};  // turning is expensive
  const SmallVector uneven = make_steering(drive, s, 0.1)->act(x, 0);
  EXPECT_LT(std::abs(uneven[1]), 0.1 * std::abs(even[1]));
}

TEST(SteeringRefusals, GainsThatOvershootWithHeldCommands) {
  for (const Gain& gain : gains()) {
    if (gain.law == ControlLaw::lqg) continue;  // its weights may be any positive numbers
    SteeringSettings s = settings_of(gain.motion, gain.law, gain.path);
    for (double* number : gain.of(s)) {
      const double good = std::exchange(*number, 1e4);
      EXPECT_HAS(why_not(gain.motion, s), "than ") << static_cast<int>(gain.law);
      *number = good;
    }
  }
  for (const ControlLaw law : {ControlLaw::tracking, ControlLaw::lqg})
    EXPECT_HAS(why_not(drive, law, law == ControlLaw::lqg ? point() : circle(),
                       [](auto& s) { s.most_input[1] = 28; }),
               "it must be 1 rad at most");
}

/// The bound is the limit of stability of the sampled double integrator.
TEST(SteeringRefusals, GainsOfABodyThatDoNotSettle) {
  for (const double by_rate : {5.0, 39.0, 41.0}) {
    SteeringSettings s = settings_of(body, ControlLaw::feedback_linearization, point());
    s.camera.gain_velocity_per_s = by_rate;
    const bool refused = why_not(body, s, 0.05) != "(none)";
    EXPECT_EQ(refused, by_rate > 40);
    double v = 0, p = 0.001;  // a double integrator with held acceleration
    for (int k = 0; k < 2000; ++k) {
      const double a = -s.camera.gain_position_per_s2 * p - by_rate * v;
      p += 0.05 * v + 0.05 * 0.05 / 2 * a, v += 0.05 * a;
    }
    EXPECT_EQ(std::abs(p) > 0.001, refused) << by_rate;
  }
}

}  // namespace
}  // namespace incognita
