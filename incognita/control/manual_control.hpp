// How a body moves while a person drives it.
#pragma once

#include <optional>

#include "incognita/control/settings.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

class StateArchive;

/// Largest velocities of a camera that a person flies.
inline constexpr double manual_speed_m_s = 0.5, manual_turn_rate_rad_s = 0.6;

/// A free camera: its reference moves as the person says, and (5.29) makes the camera follow it.
class ManualFlight {
 public:
  /// `t`: s, of this tick; the reference starts at the estimate at the first call.
  FreeCameraMotion::Input<double> act(const CameraState& estimate, const ManualDrive& drive, double t,
                                      const ControlSettings& settings);
  /// x, y, z (m, world) and heading (rad); of the last call.
  const Eigen::Vector4d& reference() const { return reference_; }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  Eigen::Vector4d reference_{0, 0, 0, 0};
  std::optional<double> last_t_;
};

/// A camera that an operator holds: short segments in the direction that the person says.
class ManualDisplay {
 public:
  /// What is shown; none while nothing is asked for.
  std::optional<UserCommand> show(const CameraState& estimate, const ManualDrive& drive, double t);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  std::optional<UserCommand> shown_;
};

/// The input of a vehicle. `most_input`: limits of its inputs, the first of which is its speed; its second, if there is
/// one, turns it.
SmallVector manual_input(const ManualDrive& drive, const SmallVector& most_input);

}  // namespace incognita
