// The rendered room as a World: a camera body moved by commands or by an operator.
#pragma once

#include <optional>
#include <utility>

#include "incognita/world/operator_model.hpp"
#include "incognita/world/rendered/free_camera_plant.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

class RoomWorld final : public World {
 public:
  RoomWorld(const RoomLayout& layout, const RoomSettings& settings, std::uint64_t seed,
            std::optional<OperatorActuator> actuator = {})
      : plant_(settings, layout, seed), actuator_(std::move(actuator)) {}

  /// A tick of zero duration, such as the first, only returns the start.
  std::optional<Truth> move(const Command& command, const Tick& tick) override {
    Command executed = command;
    if (actuator_ && last_t_) {
      const FreeCameraMotion::Input<double> input = actuator_->move(command, 0, plant_.state(), *last_t_);
      executed.linear_acceleration = input.head<3>();
      executed.angular_acceleration = input.tail<3>();
    }
    last_t_ = tick.t;
    return Truth{plant_.move(executed, tick.dt)};
  }

 private:
  FreeCameraPlant plant_;
  std::optional<OperatorActuator> actuator_;
  std::optional<double> last_t_;  ///< previous tick, when the command was given
};

}  // namespace incognita
