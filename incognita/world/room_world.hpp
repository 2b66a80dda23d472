// The rendered room as the loop sees it: a body that obeys commands.
#pragma once

#include "incognita/world/free_camera_plant.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

class RoomWorld final : public World {
 public:
  RoomWorld(const RoomLayout& layout, const RoomSettings& settings, std::uint64_t seed)
      : plant_(settings, layout, seed) {}

  /// A tick without duration, as the first one is, changes nothing: it says where the camera starts.
  std::optional<Truth> move(const Command& command, const Tick& tick) override {
    return Truth{plant_.move(command, tick.dt)};
  }

 private:
  FreeCameraPlant plant_;
};

}  // namespace incognita
