// From a scenario to the boxes of the loop.
#pragma once

#include <string>
#include <vector>

#include "incognita/app/loop.hpp"
#include "incognita/io/load_scenario.hpp"

namespace incognita {

struct Assembly {
  Boxes boxes;
  bool scale_is_known = true;      ///< fixed by the target; else free
  std::vector<std::string> notes;  ///< what was guessed, for printing
};

/// Throws InputError naming file and key or value.
Assembly assemble(const LoadedScenario& loaded);

}  // namespace incognita
