// Feedback linearisation of a car that is steered by its front wheels.
//
// As for two driven wheels (feedback_linearization.hpp) it gives speed v of the middle of the rear axle and
// turn rate w; the steering angle is atan(w wheelbase / v). A car turns only while it moves: |w| <= c |v|,
// with c = tan(largest angle) / wheelbase. What is wanted inside that cone is done exactly, up to the speed
// limit, and held commands come nearer as held_command.hpp says, with c times the speed limit for the turn
// rate. Outside it, which is where v is near zero and the goal lies abeam, the control point cannot go where
// it should: the car then steers fully, forwards or backwards, whichever of the directions it has is nearest
// to the wanted one, at the part of the wanted speed that lies along it, and says `saturated`. It shunts,
// each move beginning towards the goal. At rest, with nothing wanted, the wheels are straight.
#pragma once

#include <Eigen/Core>

#include "incognita/control/reference.hpp"
#include "incognita/models/planar_vehicle.hpp"

namespace incognita {

struct CarLimits {
  double max_speed_m_s = 3;       ///< of the middle of the rear axle, forwards and backwards
  double max_steering_rad = 0.5;  ///< to either side
};

struct CarCommand {
  double speed_m_s = 0;     ///< of the middle of the rear axle
  double steering_rad = 0;  ///< positive to the left
  bool saturated = false;   ///< not what was wanted
};

/// As AckermannCar takes it: the speed of the wheel where it is measured, and the steering angle.
Eigen::Vector2d wheel_input(const AckermannCar& car, const CarCommand& command);

/// Moves the car's control point with that velocity (m/s, world), or as nearly as the limits let it.
CarCommand car_for_velocity(const AckermannCar& car, double heading, const Eigen::Vector2d& velocity,
                            const CarLimits& limits);

struct CarLinearizationSettings {
  AckermannCar car{};                                        ///< its body.forward_m is not 0
  Eigen::MatrixXd gain_per_s = Eigen::Matrix2d::Identity();  ///< K, 2 x 2, symmetric and positive definite
  double hold_s = 0.1;                                       ///< how long a command is held
  CarLimits limits{};
};

class CarLinearization {
 public:
  /// Throws std::invalid_argument as FeedbackLinearization does, and for a steering limit at which the wheel
  /// whose speed is measured would stand still or turn backwards.
  explicit CarLinearization(const CarLinearizationSettings& settings);

  CarCommand act(const planar::Pose<double>& estimate, const Reference& reference) const;

 private:
  AckermannCar car_;
  Eigen::Matrix2d K_;
  CarLimits limits_;
};

}  // namespace incognita
