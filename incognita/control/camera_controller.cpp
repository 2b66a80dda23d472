#include "incognita/control/camera_controller.hpp"

#include <cmath>
#include <numbers>

#include "incognita/control/reference.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/models/heading.hpp"

namespace incognita {
namespace {

constexpr double braking_s = 0.5;

}  // namespace

CameraController::CameraController(const ControlSettings& settings, const PersonSettings& person,
                                   std::uint64_t seed)
    : settings_(settings) {
  if (person.holds) person_.emplace(person, seed, "person.0");
}

Command CameraController::act(const Estimate& estimate, const Goal& goal, const Observation& seen,
                              const Tick& tick) {
  if (!estimate.started) return {};
  const bool lost = estimate.status.state == TrackingState::lost;
  const bool feels = person_ && !seen.felt.empty();
  if (!lost) lost_t_ = -1;
  if (feels && lost_t_ < 0) last_known_ = seen.felt.front();
  if (lost) {
    if (lost_t_ < 0) lost_t_ = tick.t;
    if (person_) person_->forget();
    Command command = brake(tick);
    command.by_hand = person_.has_value();
    return command;
  }
  if (!feels) last_known_ = estimate.camera_state();
  const Gaze gaze = gaze_of(goal, tick);
  const Eigen::Vector3d rate_in_camera(0, -gaze.rate, 0);  // left about z is about -y of the camera
  Way way{goal.from, goal.to, goal.start_t, goal.end_t};
  if (person_) way = person_->obey(way, goal.decided, free_camera::position(last_known_), tick.t);
  const Reference reference = minimum_jerk(way.from, way.to, way.start_t, way.end_t, tick.t);
  Command command =
      track_reference(last_known_, reference.position, reference.velocity, reference.acceleration,
                      level_gaze(gaze.heading), rate_in_camera, settings_);
  command.by_hand = person_.has_value();
  return command;
}

/// The goal's; where it has none, to and fro about where the camera first looked.
CameraController::Gaze CameraController::gaze_of(const Goal& goal, const Tick& tick) {
  if (goal.heading_rad) return {*goal.heading_rad, goal.heading_rate_rad_s};
  if (!first_heading_) {
    first_heading_ = heading_of(free_camera::orientation(last_known_));
    first_t_ = tick.t;
  }
  const double phase = 2 * std::numbers::pi * (tick.t - *first_t_) / settings_.gaze_period_s;
  const double amplitude = settings_.gaze_amplitude_rad;
  return {*first_heading_ + amplitude * std::sin(phase),
          amplitude * std::cos(phase) * 2 * std::numbers::pi / settings_.gaze_period_s};
}

Command CameraController::brake(const Tick& tick) const {
  if (tick.t - lost_t_ >= braking_s) return {};
  return {-free_camera::velocity(last_known_) / braking_s,
          -free_camera::angular_rate(last_known_) / braking_s,
          {}};
}

}  // namespace incognita
