// Vehicles on a plane, each represented by a point fixed to the body, where the sensor is mounted: thesis (3.16).
//
// State (3): position x, y of that point (m, world) and heading of the body (rad, about z from +x). The body
// rotates about the middle of its rear (or only) axle; the point is `forward_m` ahead and `left_m` to the
// left of it. `rate` is the continuous motion, for simulation: d(state)/dt. A step holds the input and moves
// along the tangent at its start, as in (3.16), with an error of order dt^2.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string_view>

#include "incognita/math/angles.hpp"
#include "incognita/math/chart.hpp"
#include "incognita/models/motion/motion_model.hpp"

namespace incognita {

namespace planar {
template <class S>
using Pose = Eigen::Matrix<S, 3, 1>;  ///< x, y (m), heading (rad)
using PoseJacobian = Eigen::Matrix3d;
using PoseInputJacobian = Eigen::Matrix<double, 3, 2>;

inline constexpr Chart pose_chart{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}};
inline constexpr std::array<Quantity, 3> pose_quantities{
    {{"x", "m", "position"}, {"y", "m", "position"}, {"heading", "rad"}}};
inline constexpr std::array<Quantity, 2> drive_quantities{{{"speed", "m/s"}, {"turn_rate", "rad/s"}}};
inline constexpr std::array<Quantity, 2> car_quantities{{{"speed", "m/s"}, {"steering", "rad"}}};

struct Step {
  Pose<double> x;       ///< pose after dt
  PoseJacobian F;       ///< d(error after) / d(error before)
  PoseInputJacobian G;  ///< d(error after) / d(input), also for additive input noise
};
}  // namespace planar

/// The integrator of planar vehicles: arc_motion.hpp.
template <class Vehicle>
struct ArcMotion;

/// Two driven wheels on one axle. Input (2): speed of the middle of the axle (m/s), turn rate (rad/s).
struct DifferentialDrive {
  static constexpr int state_size = 3;
  static constexpr int error_size = 3;
  static constexpr int input_size = 2;
  template <class S>
  using State = planar::Pose<S>;
  template <class S>
  using Input = Eigen::Matrix<S, input_size, 1>;
  using Jacobian = planar::PoseJacobian;
  using InputJacobian = planar::PoseInputJacobian;
  using Step = planar::Step;
  static constexpr std::string_view name = "differential-drive";
  static constexpr std::string_view summary = "two driven wheels on one axle";
  static constexpr Space space = Space::plane;
  static constexpr int position_size = 2;
  static constexpr auto state = planar::pose_quantities, error = state;
  static constexpr auto input = planar::drive_quantities;
  static constexpr Chart chart = planar::pose_chart;
  using Integrator = ArcMotion<DifferentialDrive>;

  double forward_m = 0;  ///< l of (3.16)
  double left_m = 0;

  static constexpr auto parameters() {
    using P = Parameter<DifferentialDrive>;
    return std::array{P{{"sensor_forward", "m"},
                        [](DifferentialDrive& d) -> double& { return d.forward_m; },
                        {-1000, 1000},
                        "sensor ahead of the middle of the axle"},
                      P{{"sensor_left", "m"},
                        [](DifferentialDrive& d) -> double& { return d.left_m; },
                        {-1000, 1000},
                        "sensor left of the middle of the axle"}};
  }

  // Common interface with AckermannCar: velocities of the axle, and position of the point
  template <class S>
  const Input<S>& at_axle(const Input<S>& u) const {
    return u;
  }
  Eigen::Matrix2d axle_by_input(const Input<double>&) const;
  const DifferentialDrive& point() const { return *this; }

  /// d(state)/dt (m/s, m/s, rad/s): the continuous form of (3.16), with an additional lateral offset of the point.
  template <class S>
  State<S> rate(const State<S>& x, const Input<S>& u) const {
    using std::cos, std::sin;
    const S c = cos(x[2]), s = sin(x[2]);
    const S along = u[0] - u[1] * S(left_m), across = u[1] * S(forward_m);  // point velocity, body axes
    return State<S>(along * c - across * s, along * s + across * c, u[1]);
  }

  /// (3.16)
  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    const State<S> d = rate<S>(x, u);
    return State<S>(x[0] + d[0] * S(dt), x[1] + d[1] * S(dt), wrap_angle<S>(x[2] + d[2] * S(dt)));
  }

  Step step(const State<double>& x, const Input<double>& u, double dt) const;

  PoseOf<error_size> pose(const State<double>& x) const;
  double heading(const State<double>& x) const { return x[2]; }
  static State<double> at_rest(const Eigen::Vector3d& position, double heading);
};

/// A car with front-wheel steering whose speed is measured at the left rear wheel. Input (2): speed of that
/// wheel (m/s), steering angle (rad, positive to the left; it must stay well below the angle at which that
/// wheel is the center of rotation). Wheelbase and wheel: the utility car of the ACFR car-park data set.
struct AckermannCar {
  static constexpr int state_size = 3;
  static constexpr int error_size = 3;
  static constexpr int input_size = 2;
  template <class S>
  using State = planar::Pose<S>;
  template <class S>
  using Input = Eigen::Matrix<S, input_size, 1>;
  using Jacobian = planar::PoseJacobian;
  using InputJacobian = planar::PoseInputJacobian;
  using Step = planar::Step;
  static constexpr std::string_view name = "ackermann";
  static constexpr std::string_view summary = "a car steered by its front wheels";
  static constexpr Space space = Space::plane;
  static constexpr int position_size = 2;
  static constexpr auto state = planar::pose_quantities, error = state;
  static constexpr auto input = planar::car_quantities;
  static constexpr Chart chart = planar::pose_chart;
  using Integrator = ArcMotion<AckermannCar>;

  double wheelbase_m = 2.83;
  double wheel_left_m = 0.76;   ///< from the middle of the rear axle to the measured wheel
  DifferentialDrive body = {};  ///< the point, relative to the middle of the rear axle

  static constexpr auto parameters() {
    using P = Parameter<AckermannCar>;
    return std::array{P{{"wheelbase", "m"},
                        [](AckermannCar& c) -> double& { return c.wheelbase_m; },
                        {0, 1000, true},
                        "from the rear axle to the front axle"},
                      P{{"wheel_left", "m"},
                        [](AckermannCar& c) -> double& { return c.wheel_left_m; },
                        {-1000, 1000},
                        "the wheel whose speed is measured, left of the middle of the rear axle"},
                      P{{"sensor_forward", "m"},
                        [](AckermannCar& c) -> double& { return c.body.forward_m; },
                        {-1000, 1000},
                        "sensor ahead of the middle of the rear axle"},
                      P{{"sensor_left", "m"},
                        [](AckermannCar& c) -> double& { return c.body.left_m; },
                        {-1000, 1000},
                        "sensor left of the middle of the rear axle"}};
  }

  /// Speed of the middle of the rear axle (m/s) and turn rate (rad/s).
  template <class S>
  Input<S> at_axle(const Input<S>& u) const {
    using std::tan;
    const S curvature = tan(u[1]) / S(wheelbase_m);
    const S speed = u[0] / (S(1) - curvature * S(wheel_left_m));
    return Input<S>(speed, speed * curvature);
  }

  template <class S>
  State<S> rate(const State<S>& x, const Input<S>& u) const {
    return body.rate<S>(x, at_axle<S>(u));
  }

  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    return body.f<S>(x, at_axle<S>(u), dt);
  }

  /// d(at_axle) / d(input)
  Eigen::Matrix2d axle_by_input(const Input<double>& u) const;
  const DifferentialDrive& point() const { return body; }

  Step step(const State<double>& x, const Input<double>& u, double dt) const;

  PoseOf<error_size> pose(const State<double>& x) const;
  double heading(const State<double>& x) const { return x[2]; }
  static State<double> at_rest(const Eigen::Vector3d& position, double heading);
};

}  // namespace incognita
