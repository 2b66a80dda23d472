#include "incognita/decision/camera_decision.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "incognita/models/heading.hpp"
#include "incognita/slam/predict_looks.hpp"

namespace incognita {
namespace {

constexpr int imagined_steps = 15;  // of an action's period, as the thesis' 15 frames/s

/// How the camera's error grows over an action: the constant velocity model at rest, in a few steps. Linear
/// and angular parts do not mix and the commanded acceleration does not enter, so it is the same for every
/// translation.
ImaginedMotion imagine(BlockId camera, const FilterSettings& filter, double period_s) {
  const double dt = period_s / imagined_steps;
  const auto step =
      FreeCameraMotion{}.step((CameraState() << 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0).finished(),
                              Eigen::Matrix<double, 6, 1>::Zero(), dt);
  Eigen::Matrix<double, 6, 1> variances;
  variances.head<3>().setConstant(std::pow(filter.sigma_acceleration_m_s2, 2));
  variances.tail<3>().setConstant(std::pow(filter.sigma_angular_acceleration_rad_s2, 2));
  const FreeCameraMotion::Jacobian noise = step.G * variances.asDiagonal() * step.G.transpose();
  FreeCameraMotion::Jacobian A = FreeCameraMotion::Jacobian::Identity(),
                             N = FreeCameraMotion::Jacobian::Zero();
  for (int i = 0; i < imagined_steps; ++i) {
    A = step.F * A;
    N = step.F * N * step.F.transpose() + noise;
  }
  return {camera, A, N};
}

}  // namespace

CameraDecision::CameraDecision(Camera camera, const CameraSlamSettings& slam,
                               const DecisionSettings& settings)
    : camera_(std::move(camera)), slam_(slam), settings_(settings), actions_(seven_translations()) {}

double CameraDecision::score(const Estimate& estimate, const CameraState& after,
                             const ImaginedMotion& motion) {
  looks_.clear();
  for (const Landmark& landmark : estimate.catalogue) {
    if (landmark.kind == Landmark::Kind::line) continue;
    const auto look = expect_look(landmark, estimate.belief, camera_, after, slam_);
    if (look) looks_.push_back(affine_look(*look, landmark, estimate.camera, slam_.filter.sigma_pixel_px));
  }
  return information_(estimate.belief, motion, looks_);
}

Goal CameraDecision::choose(const Estimate& estimate, const Tick& tick) {
  goal_.decided = false;
  const bool lost = !estimate.started || estimate.status.state == TrackingState::lost;
  if (lost) {
    goal_.chosen = -1;
    goal_.scores.assign(actions_.size(), 0);
    return goal_;
  }
  const CameraState now = estimate.camera_state();
  const ImaginedMotion motion = imagine(estimate.camera, slam_.filter, settings_.period_s);
  const Eigen::AngleAxisd heading(heading_of(free_camera::orientation(now)), Eigen::Vector3d::UnitZ());
  goal_.scores.resize(actions_.size());
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    CameraState after = now;
    after.head<3>() += heading * actions_[i].direction * settings_.step_m;
    after.tail<6>().setZero();
    goal_.scores[i] = score(estimate, after, motion);
  }
  if (goal_.chosen < 0 || tick.t >= goal_.end_t - 1e-9) decide(now, tick);
  return goal_;
}

void CameraDecision::decide(const CameraState& now, const Tick& tick) {
  const Eigen::AngleAxisd heading(heading_of(free_camera::orientation(now)), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d from = free_camera::position(now);
  const auto end_of = [&](std::size_t i) -> Eigen::Vector3d {
    return from + heading * actions_[i].direction * settings_.step_m;
  };
  std::size_t best = actions_.size() - 1;  // stay
  if (settings_.strategy == "mutual-information") {
    for (std::size_t i = 0; i < actions_.size(); ++i) {
      const Eigen::Vector3d end = end_of(i);
      const bool allowed = (end.array() >= settings_.min_bound_m.array()).all() &&
                           (end.array() <= settings_.max_bound_m.array()).all();
      if (allowed && goal_.scores[i] > goal_.scores[best]) best = i;
    }
  }
  goal_.chosen = static_cast<int>(best);
  goal_.decided = true;
  goal_.from = from;
  goal_.to = end_of(best);
  goal_.start_t = tick.t;
  goal_.end_t = tick.t + settings_.period_s;
}

}  // namespace incognita
