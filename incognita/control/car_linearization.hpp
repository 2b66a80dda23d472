// Feedback linearization of a car steered by its front wheels.
//
// As for a differential drive (feedback_linearization.hpp), the law yields speed v of the rear axle's center
// and turn rate w; the steering angle is atan(w wheelbase / v). A car turns only while it moves: |w| <= c
// |v|, c = tan(largest angle) / wheelbase. Velocities inside this cone are realized exactly up to the speed
// limit, and held commands converge as derived in held_command.hpp, with c times the speed limit as turn rate
// limit. Outside the cone (v near zero, goal abeam) the control point cannot move as desired: the car then
// steers fully, forwards or backwards, in the feasible direction nearest to the desired one, at the desired
// speed projected onto it, and reports `saturated`. It shunts, and each segment starts towards the goal. At
// rest, with zero desired velocity, the wheels are straight.
#pragma once

#include <Eigen/Core>

#include "incognita/control/paths/reference.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

struct CarLimits {
  double max_speed_m_s = 3;       ///< at the rear axle's center, forwards and backwards
  double max_steering_rad = 0.5;  ///< to either side
};

struct CarCommand {
  double speed_m_s = 0;     ///< at the rear axle's center
  double steering_rad = 0;  ///< positive to the left
  bool saturated = false;   ///< whether it differs from the desired motion
};

/// Input of AckermannCar: the speed at the measured wheel, m/s, and the steering angle, rad.
Eigen::Vector2d wheel_input(const AckermannCar& car, const CarCommand& command);

/// Moves the car's control point with that velocity (m/s, world), or as closely as the limits allow.
CarCommand car_for_velocity(const AckermannCar& car, double heading, const Eigen::Vector2d& velocity,
                            const CarLimits& limits);

struct CarLinearizationSettings {
  AckermannCar car{};                                        ///< its body.forward_m must not be 0
  Eigen::MatrixXd gain_per_s = Eigen::Matrix2d::Identity();  ///< K, 2 x 2, symmetric positive definite
  double hold_s = 0.1;                                       ///< duration of one command
  CarLimits limits{};
};

class CarLinearization {
 public:
  /// Throws std::invalid_argument as FeedbackLinearization does, and for a steering limit at which the
  /// measured wheel would stand still or turn backwards.
  explicit CarLinearization(const CarLinearizationSettings& settings);

  CarCommand act(const planar::Pose<double>& estimate, const Reference& reference) const;

 private:
  AckermannCar car_;
  Eigen::Matrix2d K_;
  CarLimits limits_;
};

}  // namespace incognita
