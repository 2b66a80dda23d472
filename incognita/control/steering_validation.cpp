#include "incognita/control/steering_validation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/control/format_message.hpp"
#include "incognita/control/held_command.hpp"
#include "incognita/control/paths/path_speed.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/messages/unfit_setting.hpp"

namespace incognita {
namespace {

using Keys = std::vector<std::string>;

template <class... Parts>
[[noreturn]] void refuse(Keys keys, const Parts&... why) {
  throw UnfitSetting(std::move(keys), format_message(why...));
}

/// The settings of a path that decide how fast it is, and others.
Keys path_and(Keys others) {
  Keys keys{"path.rate_rad_s", "path.amplitude_rad", "path.radius_m",
            "path.speed_m_s",  "path.file",          "path.type"};
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

/// "controller.max_speed_m_s".
std::string limit_key(const AnyMotion& motion, Eigen::Index input) {
  return "controller.max_" + traits_of(motion).input[static_cast<std::size_t>(input)].kind_key();
}

void need_positive(const Keys& keys, const char* what, double value) {
  if (!(value > 0 && std::isfinite(value)))
    refuse(keys, what, " must be positive and finite, and is ", value);
}

void need_numbers(const Keys& keys, const char* what, const SmallVector& v, int size) {
  if (v.size() != size) refuse(keys, what, " need ", size, " numbers, and have ", v.size());
  if (!v.allFinite()) refuse(keys, what, " must be finite");
}

void check_limits(const AnyMotion& motion, const SteeringSettings& s) {
  const char* what = "the limits of what a vehicle can do";
  Keys keys;
  for (int i = 0; i < inputs_of(motion); ++i) keys.push_back(limit_key(motion, i));
  need_numbers(keys, what, s.most_input, inputs_of(motion));
  if (!(s.most_input.array() > 0).all())
    refuse(keys, what, " must be positive, and one is ", s.most_input.minCoeff());
}

void check_held(const AnyMotion& motion, const SteeringSettings& s) {
  need_numbers({"controller.input"}, "the inputs that are held", s.input, inputs_of(motion));
  if (s.most_input.size() == 0) return;
  check_limits(motion, s);
  if ((s.input.array().abs() <= s.most_input.array()).all()) return;
  Eigen::Index most = 0;
  (s.input.array().abs() / s.most_input.array()).maxCoeff(&most);
  refuse({"controller.input", limit_key(motion, most)},
         "the constant input exceeds what the vehicle can do: ", s.input[most], ", limit ",
         s.most_input[most]);
}

void need_speed(const SteeringSettings& s) {
  if (const auto why = unreachable(s.path, s.most_input[0]))
    refuse(path_and({"controller.max_speed_m_s"}), *why);
}

void need_point(const SteeringSettings& s) {
  if (!std::holds_alternative<PointPath>(s.path))
    refuse({"controller.law", "path.type"},
           "an LQG regulator drives to a point: take `feedback-linearization` or `tracking` for a path in "
           "time");
}

/// Limits the turn during one command, for a law that uses the heading at its start (lqg_regulator.hpp).
void need_small_turns(const SteeringSettings& s, double period_s) {
  const double turn = s.most_input[1] * period_s;
  if (!(turn <= 1))
    refuse({"controller.max_turn_rate_rad_s", "run.rate_hz"}, "at ", s.most_input[1],
           " rad/s the body may turn by ", turn, " rad in the ", period_s,
           " s for which a command is held; it must be 1 rad at most");
}

/// The same for a body in space, starting from rest.
void need_small_body_turns(const SteeringSettings& s, double period_s) {
  const double most = s.most_input.tail<3>().maxCoeff(), turn = most * period_s * period_s;
  if (!(turn <= 1))
    refuse({"controller.max_angular_acceleration_rad_s2", "run.rate_hz"}, "at ", most,
           " rad/s^2 the body may turn by ", turn, " rad in the ", period_s,
           " s for which a command is held; it must be 1 rad at most");
}

/// Requires one common number or `size` numbers.
void need_gains(const char* key, const char* what, const std::vector<double>& gains, std::size_t size) {
  if (gains.size() != 1 && gains.size() != size)
    refuse({key}, what, " needs 1 number or ", size, ", and has ", gains.size());
  for (const double number : gains) need_positive({key}, what, number);
}

void need_gain(const SteeringSettings& s, std::size_t axes) {
  need_gains("controller.gain_per_s", "the gain", s.gain_per_s, axes);
}

void check_weights(const SteeringSettings& s, std::size_t states, std::size_t inputs) {
  need_gains("controller.weight_state", "the weight of the state", s.weight_state, states);
  need_gains("controller.weight_input", "the weight of the input", s.weight_input, inputs);
}

/// On a circle a body turns at the rate of its reference.
void need_turn_rate(const SteeringSettings& s) {
  const auto* circle = std::get_if<CirclePath>(&s.path);
  if (circle && !(std::abs(circle->rate_rad_s) <= s.most_input[1]))
    refuse({"path.rate_rad_s", "controller.max_turn_rate_rad_s"}, "the circle turns with ",
           std::abs(circle->rate_rad_s), " rad/s, the vehicle with at most ", s.most_input[1]);
}

/// The car's control point is `forward_m` ahead of the axle and moves on a larger circle than the axle's tightest.
void need_wide_circle(const AckermannCar& car, const SteeringSettings& s) {
  const auto* circle = std::get_if<CirclePath>(&s.path);
  if (!circle || !(s.most_input[1] < std::numbers::pi / 2)) return;
  const double axle = car.wheelbase_m / std::tan(s.most_input[1]);
  const double side = axle - std::copysign(car.body.left_m, circle->rate_rad_s);
  const double tightest = std::hypot(side, car.body.forward_m);
  if (!(circle->radius_m >= tightest))
    refuse({"path.radius_m", "controller.max_steering_rad", "vehicle.wheelbase_m", "vehicle.model"},
           "the circle's radius is ", circle->radius_m, " m, and the car's steering allows ", tightest);
}

/// Kanayama's law controls the heading, which must be the direction of travel.
void need_heading_along(const Path& path) {
  constexpr double most_rad = 0.2;
  const char* instead = "; tracking holds the heading too, take `feedback-linearization`";
  const Keys keys{"controller.law", "path.type", "path.file"};
  if (std::holds_alternative<BackAndForthPath>(path))
    refuse(keys, "the path faces its center and not where it goes", instead);
  const auto* sampled = std::get_if<SampledPath>(&path);
  if (!sampled) return;
  for (const double t : sampled->spline.t) {
    const PoseMotion motion = at(sampled->spline, t);
    if (motion.rate.head<2>().norm() < 1e-9) continue;
    const double off = wrap_angle(motion.pose[3] - std::atan2(motion.rate.y(), motion.rate.x()));
    if (std::abs(off) > most_rad)
      refuse(keys, "at t = ", t, " s the path faces ", off, " rad away from where it goes", instead);
  }
}

/// Near the path, Kanayama's error ahead obeys e' = -K_x e, and the lateral error is a double integrator
/// driven by v^2 (K_y e + K_theta e'/v), so the highest speed is critical.
void check_tracking(const SteeringSettings& s, double period_s) {
  const char *along = "controller.gain_along_per_s", *across = "controller.gain_across_per_m2",
             *heading = "controller.gain_heading_per_m";
  const double v = greatest_speed(s.path).m_s;
  if (!(v > 0))
    refuse({"controller.law", "path.type", "path.points_m", "path.rate_rad_s", "path.amplitude_rad"},
           "tracking follows a reference that moves: take `feedback-linearization` for a point");
  need_speed(s);
  need_turn_rate(s);
  need_small_turns(s, period_s);
  need_heading_along(s.path);
  need_positive({along}, "the gain along", s.gain_along_per_s);
  need_positive({across}, "the gain across", s.gain_across_per_m2);
  need_positive({heading}, "the gain on the heading", s.gain_heading_per_m);
  if (!(s.gain_along_per_s * period_s < 2))
    refuse({along, "run.rate_hz"}, "the gain along, ", s.gain_along_per_s, " 1/s, must be less than ",
           2 / period_s, " 1/s where commands are held for ", period_s, " s");
  if (const auto why =
          acceleration_gain_refusal(v * v * s.gain_across_per_m2, v * s.gain_heading_per_m, period_s))
    refuse(
        {across, heading, "run.rate_hz", "path.rate_rad_s", "path.radius_m", "path.speed_m_s", "path.file"},
        "across the path, at ", v, " m/s: ", *why);
}

/// Conditions of (5.29) on a path in time.
void check_body_tracking(const SteeringSettings& s, double period_s) {
  const ControlSettings& c = s.camera;
  const char *acceleration = "controller.max_acceleration_m_s2",
             *angular = "controller.max_angular_acceleration_rad_s2";
  need_positive({acceleration}, "the greatest acceleration", c.max_acceleration_m_s2);
  need_positive({angular}, "the greatest angular acceleration", c.max_angular_acceleration_rad_s2);
  if (const auto why = acceleration_gain_refusal(c.gain_position_per_s2, c.gain_velocity_per_s, period_s))
    refuse({"controller.gain_position_per_s2", "controller.gain_velocity_per_s", "run.rate_hz"},
           "of the position: ", *why);
  if (const auto why = acceleration_gain_refusal(c.gain_orientation_per_s2, c.gain_rate_per_s, period_s))
    refuse({"controller.gain_orientation_per_s2", "controller.gain_rate_per_s", "run.rate_hz"},
           "of the gaze: ", *why);
  const PathAcceleration asked = greatest_acceleration(s.path);
  const double most = std::min(c.max_acceleration_m_s2, s.most_input.head<3>().minCoeff());
  const double most_angular = std::min(c.max_angular_acceleration_rad_s2, s.most_input.tail<3>().minCoeff());
  if (!(asked.m_s2 <= most))
    refuse(path_and({acceleration}), "the path asks for ", asked.m_s2, " m/s^2, the body has ", most,
           " m/s^2");
  if (!(asked.rad_s2 <= most_angular))
    refuse(path_and({angular}), "the gaze asks for ", asked.rad_s2, " rad/s^2, the body has ", most_angular,
           " rad/s^2");
}

/// Each motion states what it requires of every law, so that the compiler names the places for a new one.
struct SteeringCheck {
  const SteeringSettings& s;
  double period_s;

  void operator()(const MonobotMotion&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        need_point(s);
        return check_weights(s, 1, 1);
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    need_gain(s, 1);
    if (!(s.gain_per_s[0] * period_s < 2))
      refuse({"controller.gain_per_s", "run.rate_hz"},
             "the gain of a vehicle on a line must be more than 0, and times the period less than 2");
    need_speed(s);
  }
  void operator()(const DifferentialDrive& body) const {
    if (!std::isfinite(body.forward_m) || !std::isfinite(body.left_m))
      refuse({"vehicle.sensor_forward_m", "vehicle.sensor_left_m"},
             "the point that the state describes must be at a finite distance from the axle");
    switch (s.law) {
      case ControlLaw::lqg:
        need_point(s);
        need_small_turns(s, period_s);
        return check_weights(s, 2, 2);
      case ControlLaw::tracking:
        return check_tracking(s, period_s);
      case ControlLaw::none:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    check_linearization();
  }
  void operator()(const AckermannCar& car) const {
    switch (s.law) {
      case ControlLaw::feedback_linearization:
        need_speed(s);
        need_wide_circle(car, s);
        return need_gain(s, 2);
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::lqg:
      case ControlLaw::active:
        break;
    }
    refuse({"controller.law", "vehicle.model"},
           "a car is steered by `feedback-linearization`: it turns only while it moves");
  }
  void operator()(const TerrainVehicle&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        refuse({"controller.law", "vehicle.model"},
               "a regulator at rest does not know the slopes: take `feedback-linearization` or `tracking`");
      case ControlLaw::tracking:
        return check_tracking(s, period_s);
      case ControlLaw::none:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    check_linearization();
  }
  void operator()(const FreeCameraMotion&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        need_point(s);
        need_small_body_turns(s, period_s);
        return check_weights(s, 12, 6);
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    check_body_tracking(s, period_s);
  }
  void check_linearization() const {
    need_speed(s);
    need_turn_rate(s);
    need_gain(s, 2);
  }
  template <class Model>
  void operator()(const Model& model) const {
    if constexpr (requires { model.steered_as(); })
      (*this)(model.steered_as());
    else
      refuse({"controller.law", "vehicle.model"}, "no law steers the motion `", std::string(Model::name),
             "`: take `none`");
  }
};

}  // namespace

void check_steering(const AnyMotion& motion, const SteeringSettings& s, double period_s) {
  need_positive({"run.rate_hz"}, "the time for which a command is held", period_s);
  if (s.law == ControlLaw::none) return check_held(motion, s);
  check_limits(motion, s);
  check(s.path);
  std::visit(SteeringCheck{s, period_s}, motion);
}

}  // namespace incognita
