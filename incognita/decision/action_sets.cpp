#include "incognita/decision/action_sets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/motion/held_acceleration.hpp"

namespace incognita {
namespace {

constexpr int imagined_steps = 15;  // per period: 15 Hz frame rate of the thesis

template <class Actions, class IsStay>
int first_where(const Actions& actions, const IsStay& is_stay) {
  const auto at = std::find_if(actions.begin(), actions.end(), is_stay);
  if (at == actions.end())
    throw std::invalid_argument("none of the actions stays: what is done where nothing is allowed?");
  return static_cast<int>(at - actions.begin());
}

}  // namespace

Eigen::Vector4d turned_left(const Eigen::Vector4d& world_from_camera, double rad) {
  return quaternion_product<double>(quaternion_exp<double>(Eigen::Vector3d(0, 0, rad)), world_from_camera);
}

int find_stay(const std::vector<Translation>& actions) {
  return first_where(actions, [](const Translation& a) { return a.displacement_m.isZero(); });
}

int find_stay(const std::vector<SpeedChange>& actions) {
  return first_where(actions, [](const SpeedChange& a) { return a.change.isZero(); });
}

Growth growth_over(double period_s, double sigma_acceleration_m_s2,
                   double sigma_angular_acceleration_rad_s2) {
  const double dt = period_s / imagined_steps;
  const auto step = HeldAcceleration{}.step(
      (FreeCameraMotion::State<double>() << 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0).finished(),
      FreeCameraMotion::Input<double>::Zero(), dt);
  FreeCameraMotion::Input<double> variances;
  variances.head<3>().setConstant(std::pow(sigma_acceleration_m_s2, 2));
  variances.tail<3>().setConstant(std::pow(sigma_angular_acceleration_rad_s2, 2));
  const FreeCameraMotion::Jacobian noise = step.G * variances.asDiagonal() * step.G.transpose();
  Growth growth{FreeCameraMotion::Jacobian::Identity(), FreeCameraMotion::Jacobian::Zero()};
  for (int i = 0; i < imagined_steps; ++i) {
    growth.A = (step.F * growth.A).eval();
    growth.N = (step.F * growth.N * step.F.transpose() + noise).eval();
  }
  return growth;
}

Translations::Translations(std::vector<Translation> actions, double period_s, const Growth& growth,
                           const WorldBounds& bounds)
    : actions_(std::move(actions)),
      period_s_(period_s),
      growth_(growth),
      bounds_(bounds),
      stay_(find_stay(actions_)) {}

namespace {

/// An elevation that turns back at the largest one.
double nodded(double elevation_rad, double by_rad, double max_rad) {
  const double to_rad = std::clamp(elevation_rad, -max_rad, max_rad) + by_rad;
  return std::clamp(std::abs(to_rad) > max_rad ? std::copysign(2 * max_rad, to_rad) - to_rad : to_rad,
                    -max_rad, max_rad);
}

}  // namespace

ActionOutcome Translations::after(const BlockVector& state, int action) const {
  ActionOutcome out{state, growth_.A, growth_.N};
  const Eigen::Vector4d gaze = state.segment<4>(3);
  const Eigen::AngleAxisd heading(heading_of(gaze), Eigen::Vector3d::UnitZ());
  out.state.head<3>() += heading * actions_[static_cast<std::size_t>(action)].displacement_m;
  const double left_rad = gaze_rate_rad_s_ * period_s_, up_rad = elevation_rate_rad_s_ * period_s_;
  out.state.segment<4>(3) =
      max_elevation_rad_ > 0
          ? gaze_at(heading_of(gaze) + left_rad, nodded(elevation_of(gaze), up_rad, max_elevation_rad_))
          : turned_left(gaze, left_rad);
  out.state.tail<6>().setZero();
  if (action != stay_) out.outside_m = bounds_.outside_m(out.state.head<3>());
  return out;
}

Turns::Turns(double rate_rad_s, double ahead_s, const Growth& growth)
    : rate_rad_s_(rate_rad_s), ahead_s_(ahead_s), growth_(growth) {}

ActionOutcome Turns::after(const BlockVector& state, int action) const {
  ActionOutcome out{state, growth_.A, growth_.N};
  out.state.head<3>() += state.segment<3>(7) * ahead_s_;
  out.state.segment<4>(3) = turned_left(state.segment<4>(3), rate_of(action) * ahead_s_);
  return out;
}

namespace {

/// The height of a ground vehicle follows from the ground, not from the action, so z is unbounded.
WorldBounds over_ground(WorldBounds bounds) {
  bounds.min_m.z() = WorldBounds{}.min_m.z();
  bounds.max_m.z() = WorldBounds{}.max_m.z();
  return bounds;
}

}  // namespace

SpeedChanges::SpeedChanges(std::vector<SpeedChange> actions, double period_s, const Growth& growth,
                           const WorldBounds& bounds, const Mount& mount, double max_speed_m_s,
                           double max_turn_rate_rad_s)
    : actions_(std::move(actions)),
      period_s_(period_s),
      growth_(growth),
      bounds_(over_ground(bounds)),
      mount_(mount),
      max_speed_m_s_(max_speed_m_s),
      max_turn_rate_rad_s_(max_turn_rate_rad_s),
      stay_(find_stay(actions_)) {}

Eigen::Vector2d SpeedChanges::after(const Eigen::Vector2d& speeds, int action) const {
  const Eigen::Vector2d wished = speeds + actions_[static_cast<std::size_t>(action)].change;
  return {std::clamp(wished.x(), -max_speed_m_s_, max_speed_m_s_),
          std::clamp(wished.y(), -max_turn_rate_rad_s_, max_turn_rate_rad_s_)};
}

BlockVector SpeedChanges::along(const BlockVector& state, int action, double s) const {
  BlockVector out = state;
  const Eigen::Vector2d speeds = after(Eigen::Vector2d(state.tail<2>()), action);
  // The axle's center moves along an arc in the plane of the body axes (x ahead, y left, z normal)
  const double turn = speeds.y() * s, way = speeds.x() * s;
  const double half = turn / 2, chord = std::abs(half) < 1e-8 ? way : way * std::sin(half) / half;
  const Eigen::Vector3d gone(chord * std::cos(half), chord * std::sin(half), 0);
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d world_from_camera = rotation_matrix<double>(Eigen::Vector4d(state.segment<4>(3)));
  const Eigen::Matrix3d body_from_camera = mount_.body_from_camera();
  const Eigen::Matrix3d world_from_body = world_from_camera * body_from_camera.transpose();
  const Eigen::Vector3d lever = mount_.lever();
  out.head<3>() += world_from_body * (gone + turned * lever - lever);
  out.segment<4>(3) = quaternion_from_matrix(world_from_body * turned * body_from_camera);
  out.tail<2>() = speeds;
  return out;
}

ActionOutcome SpeedChanges::after(const BlockVector& state, int action) const {
  ActionOutcome out{along(state, action, period_s_), growth_.A, growth_.N};
  out.outside_m = outside_m(out.state);  // also for "stay", which keeps driving
  return out;
}

}  // namespace incognita
