// The true motion of a camera that moves freely in the room.
#pragma once

#include <cstdint>

#include "incognita/math/random.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/world/rendered/room_layout.hpp"
#include "incognita/world/settings.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

/// Integrates the continuous motion behind thesis (5.24): p' = v, q' = 1/2 q (0, w), v' = f + noise, w' = a +
/// noise. Command and disturbance are held over a tick. Walls and boxes stop the body, they do not break it.
class FreeCameraPlant {
 public:
  using State = FreeCameraMotion::State<double>;

  /// Throws std::invalid_argument when the start lies outside the room or a sigma cannot be.
  FreeCameraPlant(const RoomSettings& settings, const RoomLayout& layout, std::uint64_t seed);

  /// The state after `dt_s` seconds; none pass when it is 0. Throws std::invalid_argument when the command or
  /// the time is not finite or the time is negative.
  const State& move(const Command& command, double dt_s);

  const State& state() const { return state_; }

 private:
  void stop_at_obstacles(const Eigen::Vector3d& before);
  bool stop_at_box(const Box& box, const Eigen::Vector3d& before);

  Box inside_;              ///< where the body's centre can be
  std::vector<Box> boxes_;  ///< where it cannot
  double sigma_acceleration_m_s2_, sigma_angular_acceleration_rad_s2_;
  RandomStream disturbance_;
  State state_ = State::Zero();
};

}  // namespace incognita
