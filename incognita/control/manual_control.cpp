#include "incognita/control/manual_control.hpp"

#include <cmath>

#include "incognita/control/track_reference.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

constexpr double segment_s = 0.5;

/// m/s, world.
Eigen::Vector3d velocity_of(const ManualDrive& drive, double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  const Eigen::Vector3d& d = drive.direction;
  return manual_speed_m_s * Eigen::Vector3d(c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z());
}

}  // namespace

FreeCameraMotion::Input<double> ManualFlight::act(const CameraState& estimate, const ManualDrive& drive,
                                                  double t, const ControlSettings& settings) {
  if (!last_t_) reference_ << free_camera::position(estimate), heading_of(free_camera::orientation(estimate));
  const double dt = t - last_t_.value_or(t), rate = manual_turn_rate_rad_s * drive.turn;
  last_t_ = t;
  const Eigen::Vector3d velocity = velocity_of(drive, reference_[3]);
  reference_.head<3>() += dt * velocity;
  reference_[3] = wrap_angle(reference_[3] + dt * rate);
  const Eigen::Vector3d rate_in_camera(0, -rate, 0);  // left about z is about -y of the camera
  return track_reference(estimate, reference_.head<3>(), velocity, Eigen::Vector3d::Zero(),
                         level_gaze(reference_[3]), rate_in_camera, settings);
}

std::optional<UserCommand> ManualDisplay::show(const CameraState& estimate, const ManualDrive& drive,
                                               double t) {
  if (drive.direction.isZero() && drive.turn == 0) {
    shown_.reset();
    return shown_;
  }
  if (shown_ && !has_come(shown_->segment.end_t, t)) {
    shown_->is_new = false;
    return shown_;
  }
  const Eigen::Vector3d from = free_camera::position(estimate);
  const double heading = heading_of(free_camera::orientation(estimate));
  const double rate = manual_turn_rate_rad_s * drive.turn;
  const Eigen::Vector3d to = from + segment_s * velocity_of(drive, heading);
  shown_ = UserCommand{{from, to, t, t + segment_s}, true, Heading{heading + segment_s * rate, rate}};
  return shown_;
}

SmallVector manual_input(const ManualDrive& drive, const SmallVector& most_input) {
  SmallVector input = SmallVector::Zero(most_input.size());
  if (input.size() > 0) input[0] = drive.direction.x() * most_input[0];
  if (input.size() > 1) input[1] = drive.turn * most_input[1];
  return input;
}

}  // namespace incognita
