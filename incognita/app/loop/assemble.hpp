// Builds the components of the loop from a camera scenario.
#pragma once

#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

struct Assembly {
  LoopParts parts;
  bool scale_is_known = true;      ///< fixed by the target; else unobservable
  std::vector<std::string> notes;  ///< assumptions, for printing
};

/// Checks that the target is at the position of the room's sheet, which depends on the room's size: otherwise
/// the start pose would be wrong and overconfident. Throws InputError.
void check_sheet(const LoadedScenario& loaded, const Target& target, const Sheet& sheet);

/// Throws InputError naming file and key or value.
Assembly assemble(const LoadedScenario& loaded);

}  // namespace incognita
