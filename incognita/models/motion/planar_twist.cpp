#include "incognita/models/motion/planar_twist.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace incognita {

PlanarTwist::Step PlanarTwist::step(const State<double>& x, const Input<double>& u, double dt) const {
  const ArcTerms<double> arc(u[2] * dt);
  const Eigen::Matrix2d R = planar::rotation(x[2]);
  Step step{f<double>(x, u, dt), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()};
  step.F(0, 2) = -(step.x[1] - x[1]);
  step.F(1, 2) = step.x[0] - x[0];
  Eigen::Matrix2d by_velocity;
  by_velocity << arc.s, -arc.c, arc.c, arc.s;
  const Eigen::Vector2d by_bend(u[0] * arc.ds - u[1] * arc.dc, u[0] * arc.dc + u[1] * arc.ds);
  step.G.topLeftCorner<2, 2>() = R * by_velocity * dt;
  step.G.topRightCorner<2, 1>() = R * by_bend * dt * dt;
  step.G(2, 2) = dt;
  return step;
}

std::optional<MeasuredTwist> twist_of_increment(const planar::Pose<double>& increment,
                                                const Eigen::Matrix3d& cov, double period_s) {
  if (!(std::abs(increment[2]) < std::numbers::pi) || !(period_s > 0)) return std::nullopt;
  const ArcTerms<double> arc(increment[2]);
  const double norm = arc.s * arc.s + arc.c * arc.c;  // more than 0 within half a circle
  const double dx = increment[0], dy = increment[1];
  const Eigen::Vector3d twist((arc.s * dx + arc.c * dy) / norm, (arc.s * dy - arc.c * dx) / norm,
                              increment[2]);
  MeasuredTwist out{twist / period_s, {}, period_s};
  const Eigen::Matrix3d by_increment =
      PlanarTwist().step(planar::Pose<double>::Zero(), out.twist, period_s).G.inverse();
  out.cov = by_increment * cov * by_increment.transpose();
  return out;
}

MeasuredTwist twist_of_point(const MeasuredTwist& body, double forward_m, double left_m) {
  Eigen::Matrix3d to_point = Eigen::Matrix3d::Identity();
  to_point(0, 2) = -left_m;
  to_point(1, 2) = forward_m;
  return {to_point * body.twist, to_point * body.cov * to_point.transpose(), body.period_s};
}

}  // namespace incognita
