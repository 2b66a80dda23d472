#include "incognita/models/motion/held_acceleration.hpp"

namespace incognita {

HeldAcceleration::Step HeldAcceleration::step(const State<double>& x, const Input<double>& u,
                                              double dt) const {
  Step s{f<double>(x, u, dt), Jacobian::Identity(), InputJacobian::Zero()};
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d turn = (x.segment<3>(10) + u.tail<3>() * dt / 2) * dt;
  const Eigen::Matrix3d J = right_jacobian(turn);
  s.F.block<3, 3>(0, 6) = dt * I;
  s.F.block<3, 3>(3, 3) = rotation_exp<double>(-turn);
  s.F.block<3, 3>(3, 9) = dt * J;
  s.G.block<3, 3>(0, 0) = dt * dt / 2 * I;
  s.G.block<3, 3>(3, 3) = dt * dt / 2 * J;
  s.G.block<3, 3>(6, 0) = dt * I;
  s.G.block<3, 3>(9, 3) = dt * I;
  return s;
}

}  // namespace incognita
