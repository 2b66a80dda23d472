#include "incognita/models/motion/planar_vehicle.hpp"

#include <cmath>

namespace incognita {

Eigen::Matrix2d DifferentialDrive::axle_by_input(const Input<double>&) const {
  return Eigen::Matrix2d::Identity();
}

planar::Step DifferentialDrive::step(const State<double>& x, const Input<double>& u, double dt) const {
  const double c = std::cos(x[2]), s = std::sin(x[2]);
  const double along = u[0] - u[1] * left_m, across = u[1] * forward_m;
  Step step{f<double>(x, u, dt), Jacobian::Identity(), InputJacobian::Zero()};
  step.F(0, 2) = -(along * s + across * c) * dt;  // (3.17) has an error in the last entry of this row
  step.F(1, 2) = (along * c - across * s) * dt;
  step.G << c, -left_m * c - forward_m * s,  //
      s, -left_m * s + forward_m * c,        //
      0, 1;                                  // (3.18) lacks dt in this row
  step.G *= dt;
  return step;
}

PoseOf<DifferentialDrive::error_size> DifferentialDrive::pose(const State<double>& x) const {
  return pose_on_floor<error_size>(x[0], x[1], x[2]);
}

planar::Pose<double> DifferentialDrive::at_rest(const Eigen::Vector3d& position, double heading) {
  return {position.x(), position.y(), heading};
}

Eigen::Matrix2d AckermannCar::axle_by_input(const Input<double>& u) const {
  const double curvature = std::tan(u[1]) / wheelbase_m;
  const double d_curvature = (1 + std::pow(std::tan(u[1]), 2)) / wheelbase_m;  // by the steering angle
  const double slower = 1 - curvature * wheel_left_m;
  Eigen::Matrix2d J;
  J << 1 / slower, u[0] * wheel_left_m * d_curvature / (slower * slower),  //
      curvature / slower, u[0] * d_curvature / (slower * slower);
  return J;
}

planar::Step AckermannCar::step(const State<double>& x, const Input<double>& u, double dt) const {
  Step step = body.step(x, at_axle<double>(u), dt);
  step.G = (step.G * axle_by_input(u)).eval();
  return step;
}

PoseOf<AckermannCar::error_size> AckermannCar::pose(const State<double>& x) const { return body.pose(x); }

planar::Pose<double> AckermannCar::at_rest(const Eigen::Vector3d& position, double heading) {
  return DifferentialDrive::at_rest(position, heading);
}

}  // namespace incognita
