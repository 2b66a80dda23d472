// True motion of a free camera in the rendered room.
#pragma once

#include <cstdint>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/world/rendered/room_layout.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

/// Integrates the continuous motion behind thesis (5.24): p' = v, q' = 1/2 q (0, w), v' = f + noise, w' = a +
/// noise. Command and disturbance are held over a tick. Walls and boxes stop the body.
class FreeCameraPlant {
 public:
  using State = FreeCameraMotion::State<double>;

  /// Throws std::invalid_argument if the start lies outside the room or a sigma is invalid.
  FreeCameraPlant(const RoomSettings& settings, const RoomLayout& layout, std::uint64_t seed);

  /// State after `dt_s` seconds; unchanged if it is 0. Throws std::invalid_argument if the input or the
  /// time is not finite or the time is negative.
  const State& move(FreeCameraMotion::Input<double> input, double dt_s);

  const State& state() const { return state_; }

 private:
  void stop_at_obstacles(const Eigen::Vector3d& before);
  bool stop_at_box(const Box& box, const Eigen::Vector3d& before);

  Box inside_;              ///< admissible positions of the body's center
  std::vector<Box> boxes_;  ///< forbidden positions of the center
  double sigma_acceleration_m_s2_, sigma_angular_acceleration_rad_s2_;
  RandomStream disturbance_;
  State state_ = State::Zero();
};

}  // namespace incognita
