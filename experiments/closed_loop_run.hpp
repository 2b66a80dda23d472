// Planar robots that are steered by their estimate while they map: the simulated runs of Examples 5.1 to 5.3.
//
// Fixed before anything was compared, where the thesis is silent: the control point and the sensor are 0.3 m
// before the axle (Example 3.4's); a scanner of half a turn, five scans a second, 0.1 m and 1 degree (the car
// park's); inputs disturbed by 0.1 m/s and 0.1 rad/s, drawn for each tick and known to the filter; at most
// 1 m/s and 1 rad/s; ten ticks a second. The start is known to 0.05 m and 0.5 degrees, and fixes the frame.
// The plant is integrated, the filter is an EKF along arcs, and the identities of landmarks are known.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/run_trace.hpp"
#include "incognita/control/steering.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita::closed_loop {

inline constexpr double period_s = 0.1;                               ///< of ticks; a command is held so long
inline constexpr DifferentialDrive body{0.3, 0};                      ///< where the control point is
inline constexpr double top_speed_m_s = 1, top_turn_rate = 1;         ///< m/s, rad/s
inline const Eigen::Vector3d start_sigmas(0.05, 0.05, radians(0.5));  ///< m, m, rad
inline const Eigen::Vector2d input_sigmas(0.1, 0.1);                  ///< m/s, rad/s, of each tick
inline const Eigen::Vector2d measurement_sigmas(0.1, radians(1));     ///< m, rad
inline constexpr int ticks_per_scan = 2;

struct Robot {
  planar::Pose<double> start = planar::Pose<double>::Zero();  ///< of the control point, as the filter has it
  SteeringSettings steering;                                  ///< law, path and gains
};

/// 16 landmarks, drawn once over 24 m x 24 m: 2.5 m from each other, 1 m from the line of Example 5.1 and the
/// circles of Examples 5.2 and 5.3.
PointLandmarks sixteen_landmarks();

/// The state that the laws are given.
enum class SteeredBy {
  estimate,  ///< closed loop
  truth,
  plan  ///< open loop: where the robot would be without noise, so that its inputs are known beforehand
};

struct Setup {
  std::vector<Robot> robots;
  PointLandmarks place = sixteen_landmarks();
  int anchors = 0;  ///< the first so many landmarks are known to the filter
  double duration_s = 60;
  double noise = 1;  ///< all sigmas, of start, inputs and sensor, times this
  Linearization linearization = Linearization::analytic;
  SteeredBy steered_by = SteeredBy::estimate;
};

Robot robot(const planar::Pose<double>& start, ControlLaw law, const Path& path);

using RobotInstant = PoseInstant;

struct Instant {
  double t_s = 0;
  std::vector<RobotInstant> robots;
  std::vector<double> traces;  ///< of the landmarks' covariances, by identity, m^2; NaN before it is mapped
};

struct MappedLandmark {
  Eigen::Vector2d truth, mean;
  Eigen::Matrix2d covariance;
};

struct Run {
  std::vector<Instant> instants;
  std::vector<MappedLandmark> map;  ///< at the end
  std::vector<double> joint_nees;   ///< of robots and landmarks together, over their number; once a second
};

/// Same setup, same seed, same run.
Run drive(const Setup& setup, std::uint64_t seed);

}  // namespace incognita::closed_loop
