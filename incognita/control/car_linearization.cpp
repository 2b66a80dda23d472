#include "incognita/control/car_linearization.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "incognita/control/feedback_linearization.hpp"
#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;

double tightest_curvature(const AckermannCar& car, const CarLimits& limits) {
  return std::tan(limits.max_steering_rad) / car.wheelbase_m;
}

/// Speed and turn rate on the boundary of the feasible cone, nearest in direction to a desired velocity of
/// the control point (m/s, body axes).
Vector2d on_the_edge(const DifferentialDrive& body, double curvature, const Vector2d& desired) {
  Vector2d best = Vector2d::Zero();
  double most = 0;
  for (const double way : {1.0, -1.0}) {  // forwards wins a tie
    for (const double bend : {curvature, -curvature}) {
      const Vector2d moved = way * Vector2d(1 - bend * body.left_m, bend * body.forward_m);  // per axle speed
      const double along = desired.dot(moved.normalized());
      if (along <= most) continue;
      most = along;
      best = way * along / moved.norm() * Vector2d(1, bend);
    }
  }
  return best;
}

}  // namespace

Vector2d wheel_input(const AckermannCar& car, const CarCommand& command) {
  const double curvature = std::tan(command.steering_rad) / car.wheelbase_m;
  return {command.speed_m_s * (1 - curvature * car.wheel_left_m), command.steering_rad};
}

CarCommand car_for_velocity(const AckermannCar& car, double heading, const Vector2d& velocity,
                            const CarLimits& limits) {
  const double tightest = tightest_curvature(car, limits);
  Vector2d input = input_for_velocity(car.body, heading, velocity);
  const bool too_tight = std::abs(input[1]) > tightest * std::abs(input[0]);
  if (too_tight) input = on_the_edge(car.body, tightest, planar::rotation(heading).transpose() * velocity);
  const double curvature = input[0] == 0 ? 0 : std::clamp(input[1] / input[0], -tightest, tightest);
  const bool too_fast = std::abs(input[0]) > limits.max_speed_m_s;
  return {
      std::clamp(input[0], -limits.max_speed_m_s, limits.max_speed_m_s),
      std::clamp(std::atan(curvature * car.wheelbase_m), -limits.max_steering_rad, limits.max_steering_rad),
      too_tight || too_fast};
}

/// The turn rate of a car follows from its steering angle and speed.
static UnfitSetting of_car(UnfitSetting unfit) {
  const auto turns = std::find(unfit.keys.begin(), unfit.keys.end(), "controller.max_turn_rate_rad_s");
  if (turns == unfit.keys.end()) return unfit;
  *turns = "controller.max_steering_rad";
  unfit.keys.emplace_back("controller.max_speed_m_s");
  return unfit;
}

CarLinearization::CarLinearization(const CarLinearizationSettings& settings)
    : car_(settings.car), limits_(settings.limits) {
  if (!(car_.wheelbase_m > 0)) throw std::invalid_argument("the wheelbase must be positive");
  if (!(limits_.max_steering_rad > 0 && limits_.max_steering_rad < std::numbers::pi / 2))
    throw std::invalid_argument("the steering limit must lie between 0 and pi/2 rad");
  const double tightest = tightest_curvature(car_, limits_);
  if (!(tightest * std::abs(car_.wheel_left_m) < 1)) {
    throw UnfitSetting(
        {"controller.max_steering_rad", "vehicle.wheel_left_m", "vehicle.wheelbase_m"},
        "at the steering limit the wheel whose speed is measured would be the center of the turn, or beyond "
        "it");
  }
  const PlanarLimits as_planar{limits_.max_speed_m_s, tightest * limits_.max_speed_m_s};
  try {
    const FeedbackLinearization same_law({car_.body, settings.gain_per_s, settings.hold_s, as_planar});
  } catch (const UnfitSetting& unfit) {
    throw of_car(unfit);
  }
  K_ = settings.gain_per_s;
}

CarCommand CarLinearization::act(const planar::Pose<double>& estimate, const Reference& reference) const {
  return car_for_velocity(car_, estimate[2], velocity_towards(reference, K_, estimate.head<2>()), limits_);
}

}  // namespace incognita
