// One vehicle's law: from what is believed of its state and the path it is to follow to its next input.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "incognita/control/reference_path.hpp"
#include "incognita/control/settings.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_motion.hpp"

namespace incognita {

/// A diagonal matrix of gains or weights: one number for all of it, or one each.
struct Diagonal {
  SmallVector numbers;
  Diagonal(double same) : numbers(SmallVector::Constant(1, same)) {}  // NOLINT(google-explicit-constructor)
  explicit Diagonal(SmallVector each) : numbers(std::move(each)) {}
  /// size x size, of 1 or `size` numbers.
  Eigen::MatrixXd matrix(Eigen::Index size) const {
    if (numbers.size() == 1) return numbers[0] * Eigen::MatrixXd::Identity(size, size);
    return numbers.asDiagonal();
  }
};

struct SteeringSettings {
  std::string law = "none";       ///< `none`, `tracking`, `lqg`, `feedback-linearisation`
  Path path;                      ///< where to be, by the time since the first tick
  SmallVector input;              ///< `none`: held all along; the motion's inputs
  Diagonal gain_per_s = 0.5;      ///< per axis: `feedback-linearisation`, and `tracking` on a line
  double control_point_m = 0.2;   ///< `feedback-linearisation` on uneven ground: how far before the axle
  double gain_along_per_s = 1;    ///< `tracking` on a plane: on the error ahead (Kanayama's K_x)
  double gain_across_per_m2 = 4;  ///< on the error to the side (K_y)
  double gain_heading_per_m = 2;  ///< on the sine of the heading's error (K_theta)
  Diagonal weight_state = 1;      ///< `lqg`: Q_1 of (5.1)
  Diagonal weight_input = 1;      ///< Q_2
  ControlSettings camera;  ///< of a body that moves freely in space: (5.29), and limits beside those below
  SmallVector most_input;  ///< what the body can do, either way
};

/// One vehicle's law. `period_s`: how long a command is held.
class Steering {
 public:
  virtual ~Steering() = default;
  /// The input until the next tick; `t`: s since the first.
  virtual SmallVector act(const SmallVector& estimate, double t) const = 0;
};

/// Throws std::invalid_argument with the reason where the law cannot steer that motion along that path: gains
/// that do not converge with commands held, a control point on the axle, a path that is faster or bends more
/// than the vehicle, sizes that do not fit and numbers that cannot be. No command is beyond `most_input`.
std::unique_ptr<Steering> make_steering(const AnyMotion& motion, const SteeringSettings& settings,
                                        double period_s);

}  // namespace incognita
