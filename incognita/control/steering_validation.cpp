#include "incognita/control/steering_validation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "incognita/control/format_message.hpp"
#include "incognita/control/held_command.hpp"
#include "incognita/control/paths/path_speed.hpp"
#include "incognita/math/angles.hpp"

namespace incognita {
namespace {

/// The first problem that is not empty.
std::string first_of(std::initializer_list<std::string> problems) {
  for (const std::string& problem : problems)
    if (!problem.empty()) return problem;
  return "";
}

std::string need_positive(const char* what, double value) {
  if (value > 0 && std::isfinite(value)) return "";
  return format_message(what, " must be positive and finite, and is ", value);
}

std::string need_numbers(const char* what, const SmallVector& v, int size) {
  if (v.size() != size) return format_message(what, " need ", size, " numbers, and have ", v.size());
  return v.allFinite() ? "" : format_message(what, " must be finite");
}

std::string validate_limits(const SteeringSettings& s, int inputs) {
  const char* what = "the limits of what a vehicle can do";
  std::string problem = need_numbers(what, s.most_input, inputs);
  if (!problem.empty() || (s.most_input.array() > 0).all()) return problem;
  return format_message(what, " must be positive, and one is ", s.most_input.minCoeff());
}

std::string validate_held(const SteeringSettings& s, int inputs) {
  std::string problem = need_numbers("the inputs that are held", s.input, inputs);
  if (!problem.empty() || s.most_input.size() == 0) return problem;
  std::string limits = validate_limits(s, inputs);
  if (!limits.empty() || (s.input.array().abs() <= s.most_input.array()).all()) return limits;
  Eigen::Index most = 0;
  (s.input.array().abs() / s.most_input.array()).maxCoeff(&most);
  return format_message("the constant input exceeds what the vehicle can do: ", s.input[most], ", limit ",
                        s.most_input[most]);
}

std::string need_speed(const SteeringSettings& s) {
  return unreachable(s.path, s.most_input[0]).value_or("");
}

std::string need_point(const SteeringSettings& s) {
  if (std::holds_alternative<PointPath>(s.path)) return "";
  return "an LQG regulator drives to a point: take `feedback-linearization` or `tracking` for a path in time";
}

/// Limits the turn during one command, for a law that uses the heading at its start (lqg_regulator.hpp).
std::string need_small_turns(const SteeringSettings& s, double period_s) {
  const double turn = s.most_input[1] * period_s;
  if (turn <= 1) return "";
  return format_message("at ", s.most_input[1], " rad/s the body may turn by ", turn, " rad in the ",
                        period_s, " s for which a command is held; it must be 1 rad at most");
}

/// The same for a body in space, starting from rest.
std::string need_small_body_turns(const SteeringSettings& s, double period_s) {
  const double most = s.most_input.tail<3>().maxCoeff(), turn = most * period_s * period_s;
  if (turn <= 1) return "";
  return format_message("at ", most, " rad/s^2 the body may turn by ", turn, " rad in the ", period_s,
                        " s for which a command is held; it must be 1 rad at most");
}

/// Requires one common number or `size` numbers.
std::string need_gains(const char* what, const std::vector<double>& gains, std::size_t size) {
  if (gains.size() != 1 && gains.size() != size)
    return format_message(what, " needs 1 number or ", size, ", and has ", gains.size());
  for (const double number : gains)
    if (std::string problem = need_positive(what, number); !problem.empty()) return problem;
  return "";
}

std::string validate_weights(const SteeringSettings& s, std::size_t states, std::size_t inputs) {
  return first_of({need_gains("the weight of the state", s.weight_state, states),
                   need_gains("the weight of the input", s.weight_input, inputs)});
}

/// On a circle a body turns at the rate of its reference.
std::string need_turn_rate(const SteeringSettings& s) {
  const auto* circle = std::get_if<CirclePath>(&s.path);
  if (!circle || std::abs(circle->rate_rad_s) <= s.most_input[1]) return "";
  return format_message("the circle turns with ", std::abs(circle->rate_rad_s),
                        " rad/s, the vehicle with at most ", s.most_input[1]);
}

/// The car's control point is `forward_m` ahead of the axle and moves on a larger circle than the axle's tightest.
std::string need_wide_circle(const AckermannCar& car, const SteeringSettings& s) {
  const auto* circle = std::get_if<CirclePath>(&s.path);
  if (!circle || !(s.most_input[1] < std::numbers::pi / 2)) return "";
  const double axle = car.wheelbase_m / std::tan(s.most_input[1]);
  const double side = axle - std::copysign(car.body.left_m, circle->rate_rad_s);
  const double tightest = std::hypot(side, car.body.forward_m);
  if (circle->radius_m >= tightest) return "";
  return format_message("the circle's radius is ", circle->radius_m, " m, and the car's steering allows ",
                        tightest);
}

/// Kanayama's law controls the heading, which must be the direction of travel.
std::string need_heading_along(const Path& path) {
  constexpr double most_rad = 0.2;
  const char* instead = "; tracking holds the heading too, take `feedback-linearization`";
  if (std::holds_alternative<BackAndForthPath>(path))
    return format_message("the path faces its center and not where it goes", instead);
  const auto* sampled = std::get_if<SampledPath>(&path);
  if (!sampled) return "";
  for (const double t : sampled->spline.t) {
    const PoseMotion motion = at(sampled->spline, t);
    if (motion.rate.head<2>().norm() < 1e-9) continue;
    const double off = wrap_angle(motion.pose[3] - std::atan2(motion.rate.y(), motion.rate.x()));
    if (std::abs(off) > most_rad)
      return format_message("at t = ", t, " s the path faces ", off, " rad away from where it goes", instead);
  }
  return "";
}

/// Near the path, Kanayama's error ahead obeys e' = -K_x e, and the lateral error is a double integrator
/// driven by v^2 (K_y e + K_theta e'/v), so the highest speed is critical.
std::string validate_tracking(const SteeringSettings& s, double period_s) {
  const double v = greatest_speed(s.path).m_s;
  if (!(v > 0)) return "tracking follows a reference that moves: take `feedback-linearization` for a point";
  std::string problem =
      first_of({need_speed(s), need_turn_rate(s), need_small_turns(s, period_s), need_heading_along(s.path),
                need_positive("the gain along", s.gain_along_per_s),
                need_positive("the gain across", s.gain_across_per_m2),
                need_positive("the gain on the heading", s.gain_heading_per_m)});
  if (!problem.empty()) return problem;
  if (!(s.gain_along_per_s * period_s < 2))
    return format_message("the gain along, ", s.gain_along_per_s, " 1/s, must be less than ", 2 / period_s,
                          " 1/s where commands are held for ", period_s, " s");
  const auto why =
      acceleration_gain_refusal(v * v * s.gain_across_per_m2, v * s.gain_heading_per_m, period_s);
  return why ? format_message("across the path, at ", v, " m/s: ", *why) : "";
}

/// Conditions of (5.29) on a path in time.
std::string validate_body_tracking(const SteeringSettings& s, double period_s) {
  const ControlSettings& c = s.camera;
  std::string limits =
      first_of({need_positive("the greatest acceleration", c.max_acceleration_m_s2),
                need_positive("the greatest angular acceleration", c.max_angular_acceleration_rad_s2)});
  if (!limits.empty()) return limits;
  if (const auto why = acceleration_gain_refusal(c.gain_position_per_s2, c.gain_velocity_per_s, period_s))
    return format_message("of the position: ", *why);
  if (const auto why = acceleration_gain_refusal(c.gain_orientation_per_s2, c.gain_rate_per_s, period_s))
    return format_message("of the gaze: ", *why);
  const PathAcceleration asked = greatest_acceleration(s.path);
  const double most = std::min(c.max_acceleration_m_s2, s.most_input.head<3>().minCoeff());
  const double most_angular = std::min(c.max_angular_acceleration_rad_s2, s.most_input.tail<3>().minCoeff());
  if (!(asked.m_s2 <= most))
    return format_message("the path asks for ", asked.m_s2, " m/s^2, the body has ", most, " m/s^2");
  if (!(asked.rad_s2 <= most_angular))
    return format_message("the gaze asks for ", asked.rad_s2, " rad/s^2, the body has ", most_angular,
                          " rad/s^2");
  return "";
}

/// Each motion states what it requires of every law, so that the compiler names the places for a new one.
struct SteeringValidator {
  const SteeringSettings& s;
  double period_s;

  std::string operator()(const MonobotMotion&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        return first_of({need_point(s), validate_weights(s, 1, 1)});
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    const std::string problem = need_gains("the gain", s.gain_per_s, 1);
    if (!problem.empty()) return problem;
    if (s.gain_per_s[0] * period_s < 2) return need_speed(s);
    return "the gain of a vehicle on a line must be more than 0, and times the period less than 2";
  }
  std::string operator()(const DifferentialDrive& body) const {
    if (!std::isfinite(body.forward_m) || !std::isfinite(body.left_m))
      return "the point that the state describes must be at a finite distance from the axle";
    switch (s.law) {
      case ControlLaw::lqg:
        return first_of({need_point(s), need_small_turns(s, period_s), validate_weights(s, 2, 2)});
      case ControlLaw::tracking:
        return validate_tracking(s, period_s);
      case ControlLaw::none:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    return validate_linearization();
  }
  std::string operator()(const AckermannCar& car) const {
    switch (s.law) {
      case ControlLaw::feedback_linearization:
        return first_of({need_speed(s), need_wide_circle(car, s), need_gains("the gain", s.gain_per_s, 2)});
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::lqg:
      case ControlLaw::active:
        break;
    }
    return "a car is steered by `feedback-linearization`: it turns only while it moves";
  }
  std::string operator()(const TerrainVehicle&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        return "a regulator at rest does not know the slopes: take `feedback-linearization` or `tracking`";
      case ControlLaw::tracking:
        return validate_tracking(s, period_s);
      case ControlLaw::none:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    return validate_linearization();
  }
  std::string operator()(const FreeCameraMotion&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        return first_of({need_point(s), need_small_body_turns(s, period_s), validate_weights(s, 12, 6)});
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::feedback_linearization:
      case ControlLaw::active:
        break;
    }
    return validate_body_tracking(s, period_s);
  }
  std::string validate_linearization() const {
    return first_of({need_speed(s), need_turn_rate(s), need_gains("the gain", s.gain_per_s, 2)});
  }
  template <class Model>
  std::string operator()(const Model& model) const {
    if constexpr (requires { model.steered_as(); }) return (*this)(model.steered_as());
    return format_message("no law steers the motion `", std::string(Model::name), "`: take `none`");
  }
};

}  // namespace

std::string validate_steering(const AnyMotion& motion, const SteeringSettings& s, double period_s) {
  std::string period = need_positive("the time for which a command is held", period_s);
  if (!period.empty()) return period;
  const int inputs = inputs_of(motion);
  if (s.law == ControlLaw::none) return validate_held(s, inputs);
  std::string limits = validate_limits(s, inputs);
  if (!limits.empty()) return limits;
  check(s.path);
  return std::visit(SteeringValidator{s, period_s}, motion);
}

}  // namespace incognita
