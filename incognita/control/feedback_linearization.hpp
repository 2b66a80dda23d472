// Feedback linearization of a planar vehicle: thesis (5.7) to (5.13), and (5.21) for several vehicles.
//
// The control point lies `forward_m` = l ahead of the axle and `left_m` beside it. Its velocity is linear in
// speed v and turn rate w for every heading:
//
//     ydot = Q_r (v, w)',    Q_r = R(heading) [1  -left]        (5.13) with left = 0
//                                              [0     l ]
//
// and u = Q_r^-1 (ydot* - K (y - y*)) yields ydot = ydot* - K (y - y*). The thesis prints other signs in
// (5.9) and (5.12), and y*_{k+1} for the velocity ydot*. det Q_r = l: a point on the axle line cannot move
// sideways. The heading is not controlled: a vehicle in reverse turns round by itself. Convergence is
// asymptotic, not in finite time as stated below (5.13); a moving reference is followed with a lag of about
// its speed times the turn angle during one held command.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "incognita/control/paths/reference.hpp"
#include "incognita/control/planar_command.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

/// Q_r of (5.13): maps speed (m/s) and turn rate (rad/s) of the axle to the velocity of the control point
/// (m/s, world).
Eigen::Matrix2d point_velocity_by_input(const DifferentialDrive& body, double heading);

/// Speed and turn rate that move the control point with that velocity (m/s, world). The body's l must not be 0.
Eigen::Vector2d input_for_velocity(const DifferentialDrive& body, double heading,
                                   const Eigen::Vector2d& velocity);

/// ydot* - K (y - y*): desired velocity (m/s, world) of a control point at `y`. Throws std::invalid_argument
/// if it is not finite, i.e. if the estimate or the reference is not.
Eigen::Vector2d velocity_towards(const Reference& reference, const Eigen::Matrix2d& K,
                                 const Eigen::Vector2d& y);

struct LinearizationSettings {
  DifferentialDrive body{0.3, 0};                            ///< its control point; forward_m must not be 0
  Eigen::MatrixXd gain_per_s = Eigen::Matrix2d::Identity();  ///< K, 2 x 2, symmetric positive definite
  double hold_s = 0.1;                                       ///< duration of one command
  PlanarLimits limits{};
};

class FeedbackLinearization {
 public:
  /// Throws std::invalid_argument if the law would be singular, and UnfitSetting if its held commands might not
  /// converge (held_command.hpp); the message states the reason.
  explicit FeedbackLinearization(const LinearizationSettings& settings);

  /// Command for the next `hold_s`. A saturated command still moves the control point in the desired direction.
  PlanarCommand act(const planar::Pose<double>& estimate, const Reference& reference) const;

 private:
  DifferentialDrive body_;
  Eigen::Matrix2d K_;
  PlanarLimits limits_;
};

/// (5.21): Q_r of a team is block diagonal, so the vehicles are steered independently. Throws
/// std::invalid_argument if the sizes differ.
std::vector<PlanarCommand> act_together(std::span<const FeedbackLinearization> team,
                                        std::span<const planar::Pose<double>> estimates,
                                        std::span<const Reference> references);

}  // namespace incognita
