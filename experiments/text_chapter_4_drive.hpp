// What the EKF learns from a motion: a planar vehicle, (4.11), whose odometry is noisy, maps features by their
// bearings, (4.12).
//
// Truth: the vehicle begins at the origin, heading along x. Filter: its first pose is known to `Unknowns`;
// features are placed by their first bearing and a first distance that is known to `Unknowns`, so that their
// errors depend on that of the pose, as in (2.20) to (2.26). First estimates are drawn with these sigmas.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita::bearing_drive {

struct Unknowns {
  double sigma_position_m = 0.2;
  double sigma_heading_rad = radians(3);
  double sigma_distance_m = 3;
};

/// Of each step's mean speed and turn rate, while it moves; of a bearing.
struct Noise {
  double sigma_speed_mps = 0.05;
  double sigma_turn_radps = 0.02;
  double sigma_bearing_rad = 0.02;
};

/// Where Jacobians are taken.
enum class Linearized {
  at_estimates,        ///< the EKF
  at_first_estimates,  ///< of features, and of each pose before its measurements (Huang et al., ISER 2008)
  at_truth             ///< as in Example 4.6: no errors, the covariance is the inverse of the information
};

struct Drive {
  std::vector<Eigen::Vector2d> features;
  std::vector<Eigen::Vector2d> anchors = {};
  std::function<Eigen::Vector2d(double t_s)> input;  ///< speed (m/s) and turn rate (rad/s)
  Unknowns unknowns = {};
  Noise noise = {};
  Linearized linearized = Linearized::at_estimates;
  double dt_s = 0.1;  ///< between measurements
};

/// The estimate after a measurement. Errors: truth less estimate of x, y (m), heading (rad), and x, y of each
/// feature.
struct Moment {
  double t_s = 0;
  planar::Pose<double> pose;  ///< the truth
  Eigen::VectorXd error;
  Eigen::MatrixXd covariance;

  /// Of all states, divided by their number: 1 is right.
  double nees() const;
};

/// The moments at the given times, which are multiples of the step and increase.
std::vector<Moment> drive(const Drive& settings, const std::vector<double>& times_s, std::uint64_t seed);

/// Unit vector in the state, along which the distance of a feature from the vehicle grows.
Eigen::VectorXd away(const Drive& settings, const Moment& at, int feature);

}  // namespace incognita::bearing_drive
