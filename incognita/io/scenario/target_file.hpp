// Reads known targets: positions of the corners in the world and their image patches.
//
//   name = "sheet"
//   normal = [-1, 0, 0]            # out of the printed side
//   axes = "scenelib"              # optional: x left, y up, z forward, as in SceneLib
//   [[corner]]
//   position_m = [3.0, 0.21, 1.45]
//   patch = "sheet-0.pgm"          # odd square centered at the corner; beside this file or under the data folder
//
// Without `axes`, all vectors are in world axes: x forward, y left, z up. SceneLib's (x, y, z) is (z, x, y) there.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/features/target.hpp"

namespace incognita {

/// Patches are searched beside the file, then in `patch_folders`. Throws InputError naming file, line and key.
Target read_target(const std::filesystem::path& file,
                   const std::vector<std::filesystem::path>& patch_folders = {});

/// The file named by `start.target`: beside the scenario, under the data folder, or built in.
std::filesystem::path find_target(const LoadedScenario& loaded);

/// The target of a scenario.
Target load_target(const LoadedScenario& loaded);

}  // namespace incognita
