// Builds the components of the loop for a vehicle that carries the camera through the rendered room.
#pragma once

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

struct RoomVehicleAssembly {
  LoopParts parts;
  bool scale_is_known = true;  ///< fixed by the target; else unobservable
};

/// Throws InputError naming file and key or value.
RoomVehicleAssembly assemble_room_vehicle(const LoadedScenario& loaded);

}  // namespace incognita
