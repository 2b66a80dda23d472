// A free camera in the rendered room, moved by one input after the other.
#pragma once

#include "incognita/world/rendered/room_bodies.hpp"

namespace incognita::testing {

class CameraInRoom {
 public:
  using State = FreeCameraMotion::State<double>;

  CameraInRoom(const RoomSettings& settings, const RoomLayout& layout, std::uint64_t seed)
      : world_(camera_in_room(settings, layout, seed), seed) {
    move(SmallVector::Zero(6), 0);
  }

  const State& move(const SmallVector& input, double dt_s) {
    t_ += dt_s;
    truth_ = world_.move({{BodyCommand{input}}}, {0, t_, dt_s});
    return state_ = truth_->bodies[0].state;
  }
  const State& state() const { return state_; }
  const std::optional<Truth>& truth() const { return truth_; }

 private:
  SimulatedWorld world_;
  std::optional<Truth> truth_;
  State state_;
  double t_ = 0;
};

}  // namespace incognita::testing
