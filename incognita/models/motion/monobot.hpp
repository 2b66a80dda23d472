// A robot on a line and its relative-position measurement: thesis Example 3.1, Figure 3.2.
//
// State (1): position on the line, m. Input (1): speed, m/s; with dt = 1 it is the displacement u of (3.4).
// Measurement (1): position of the landmark minus that of the robot, m.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "incognita/math/chart.hpp"
#include "incognita/models/motion/motion_model.hpp"

namespace incognita {

struct MonobotMotion {
  static constexpr int state_size = 1;
  static constexpr int error_size = 1;
  static constexpr int input_size = 1;
  template <class S>
  using State = Eigen::Matrix<S, state_size, 1>;
  template <class S>
  using Input = Eigen::Matrix<S, input_size, 1>;
  using Jacobian = Eigen::Matrix<double, error_size, error_size>;
  using InputJacobian = Eigen::Matrix<double, error_size, input_size>;

  static constexpr std::string_view name = "monobot";
  static constexpr std::string_view summary = "a robot on a line, driven by its speed";
  static constexpr Space space = Space::line;
  static constexpr int position_size = 1;
  static constexpr std::array<Quantity, 1> state{{{"x", "m", "position"}}}, error = state,
                                                                            input{{{"speed", "m/s"}}};
  static constexpr Chart chart = Chart::line(1);
  using Integrator = MonobotMotion;

  struct Step {
    State<double> x;  ///< the state after dt
    Jacobian F;       ///< d(error after) / d(error before): 1
    InputJacobian G;  ///< d(error after) / d(input): dt
  };

  /// d(state)/dt: the speed, for which (3.4) is exact.
  template <class S>
  State<S> rate(const State<S>&, const Input<S>& u) const {
    return u;
  }

  /// (3.4)
  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    return x + u * S(dt);
  }

  Step step(const State<double>& x, const Input<double>& u, double dt) const;

  PoseOf<error_size> pose(const State<double>& x) const;
  double heading(const State<double>&) const { return 0; }
  static State<double> at_rest(const Eigen::Vector3d& position, double) {
    return State<double>(position.x());
  }
};

struct RelativePosition {
  using Scalar = Eigen::Matrix<double, 1, 1>;
  struct Prediction {
    Scalar z;
    Scalar Hv{-1.0};  ///< d(z) / d(robot), (3.7)
    Scalar Hl{1.0};   ///< d(z) / d(landmark)
  };
  struct Initialization {
    Scalar landmark;
    Scalar Jv{1.0};  ///< d(landmark) / d(robot)
    Scalar Jz{1.0};  ///< d(landmark) / d(z)
  };

  /// (3.6)
  static Prediction predict_measurement(double robot, double landmark);
  static Initialization initialize(double robot, double z);
};

}  // namespace incognita
