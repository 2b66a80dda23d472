// Steering law of one vehicle: from its estimated state and its path to its next input.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "incognita/control/paths/reference_path.hpp"
#include "incognita/control/settings.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_motion.hpp"

namespace incognita {

/// A diagonal matrix of gains or weights, given by one common number or one per entry.
struct Diagonal {
  SmallVector numbers;
  Diagonal(double same) : numbers(SmallVector::Constant(1, same)) {}  // NOLINT(google-explicit-constructor)
  explicit Diagonal(SmallVector each) : numbers(std::move(each)) {}
  /// size x size; requires 1 or `size` numbers.
  Eigen::MatrixXd matrix(Eigen::Index size) const {
    if (numbers.size() == 1) return numbers[0] * Eigen::MatrixXd::Identity(size, size);
    return numbers.asDiagonal();
  }
};

enum class ControlLaw {
  none,      ///< a constant input
  tracking,  ///< of a moving reference
  lqg,       ///< linear quadratic regulator to a point
  feedback_linearization
};

struct SteeringSettings {
  ControlLaw law = ControlLaw::none;
  Path path;                      ///< in time since the first tick
  SmallVector input;              ///< `none`: constant input of the motion model
  Diagonal gain_per_s = 0.5;      ///< per axis: `feedback_linearization`, and `tracking` on a line
  double control_point_m = 0.2;   ///< `feedback_linearization` on uneven ground: distance ahead of the axle
  double gain_along_per_s = 1;    ///< `tracking` on a plane: gain on the error ahead (Kanayama's K_x)
  double gain_across_per_m2 = 4;  ///< gain on the lateral error (K_y)
  double gain_heading_per_m = 2;  ///< gain on the sine of the heading error (K_theta)
  Diagonal weight_state = 1;      ///< `lqg`: Q_1 of (5.1)
  Diagonal weight_input = 1;      ///< Q_2
  ControlSettings camera;         ///< bodies in space: gains of (5.29), and limits besides most_input
  SmallVector most_input;         ///< limits of the inputs, both signs
};

/// Steering law of one vehicle.
class Steering {
 public:
  virtual ~Steering() = default;
  /// Input until the next tick; `t`: s since the first tick.
  virtual SmallVector act(const SmallVector& estimate, double t) const = 0;
};

/// `period_s`: duration of one command. Throws std::invalid_argument, with the reason, if the law cannot steer that
/// motion along that path: gains that do not converge with held commands, a control point on the axle, a path too
/// fast or too tight for the vehicle, wrong sizes, invalid numbers. No command exceeds `most_input`.
std::unique_ptr<Steering> make_steering(const AnyMotion& motion, const SteeringSettings& settings,
                                        double period_s);

}  // namespace incognita
