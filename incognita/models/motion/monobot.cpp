#include "incognita/models/motion/monobot.hpp"

namespace incognita {

MonobotMotion::Step MonobotMotion::step(const State<double>& x, const Input<double>& u, double dt) const {
  return {f<double>(x, u, dt), Jacobian::Identity(), InputJacobian::Constant(dt)};
}

PoseOf<MonobotMotion::error_size> MonobotMotion::pose(const State<double>& x) const {
  return pose_on_line<error_size>(x[0]);
}

RelativePosition::Prediction RelativePosition::predict_measurement(double robot, double landmark) {
  return {Scalar(landmark - robot)};
}

RelativePosition::Initialization RelativePosition::initialize(double robot, double z) {
  return {Scalar(robot + z)};
}

}  // namespace incognita
