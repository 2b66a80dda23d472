// The rendered room as a World: a camera body moved by commands or by an operator.
#pragma once

#include <optional>
#include <utility>

#include "incognita/models/any_motion.hpp"
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
    FreeCameraMotion::Input<double> input = input_of(command, 0, FreeCameraMotion::input_size);
    if (actuator_ && last_t_) input = actuator_->move(command_of(command, 0), plant_.state(), *last_t_);
    last_t_ = tick.t;
    BodyTruth body;
    body.state = plant_.move(input, tick.dt);
    body.pose = pose_of(FreeCameraMotion{}, body.state);
    return Truth{{std::move(body)}};
  }

 private:
  FreeCameraPlant plant_;
  std::optional<OperatorActuator> actuator_;
  std::optional<double> last_t_;  ///< previous tick, when the command was given
};

}  // namespace incognita
