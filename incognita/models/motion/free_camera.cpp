#include "incognita/models/motion/free_camera.hpp"

#include "incognita/models/motion/heading.hpp"

namespace incognita {

FreeCameraMotion::Step FreeCameraMotion::step(const State<double>& x, const Input<double>& u,
                                              double dt) const {
  Step s{f<double>(x, u, dt), Jacobian::Identity(), InputJacobian::Zero()};
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d turn = (x.segment<3>(10) + u.tail<3>() * dt) * dt;
  const Eigen::Matrix3d J = right_jacobian(turn);
  s.F.block<3, 3>(0, 6) = dt * I;
  s.F.block<3, 3>(3, 3) = rotation_exp<double>(-turn);
  s.F.block<3, 3>(3, 9) = dt * J;
  s.G.block<3, 3>(0, 0) = dt * dt * I;
  s.G.block<3, 3>(3, 3) = dt * dt * J;
  s.G.block<3, 3>(6, 0) = dt * I;
  s.G.block<3, 3>(9, 3) = dt * I;
  return s;
}

PoseOf<FreeCameraMotion::error_size> FreeCameraMotion::pose(const State<double>& x) const {
  return pose_in_space<error_size>(x.head<3>(), x.segment<4>(3));
}

double FreeCameraMotion::heading(const State<double>& x) const { return heading_of(x.segment<4>(3)); }

FreeCameraMotion::State<double> FreeCameraMotion::at_rest(const Eigen::Vector3d& position, double heading) {
  return (State<double>() << position, level_gaze(heading), Eigen::Matrix<double, 6, 1>::Zero()).finished();
}

}  // namespace incognita
