// From a scenario to the boxes of the loop.
#pragma once

#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

struct Assembly {
  Boxes boxes;
  bool scale_is_known = true;      ///< fixed by the target; else free
  std::vector<std::string> notes;  ///< what was guessed, for printing
};

/// The target must hang where the room's sheet does: a longer room has it further away, and a start from
/// where it is not would be wrong and sure of itself. Throws InputError.
void check_sheet(const LoadedScenario& loaded, const Target& target, const Sheet& sheet);

/// Throws InputError naming file and key or value.
Assembly assemble(const LoadedScenario& loaded);

}  // namespace incognita
