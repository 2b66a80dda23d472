// Known targets from their files: where the corners are in the world and how they look.
//
//   name = "sheet"
//   normal = [-1, 0, 0]            # out of the printed side
//   axes = "scenelib"              # optional: x left, y up, z forward, as SceneLib has them
//   [[corner]]
//   position_m = [3.0, 0.21, 1.45]
//   patch = "sheet-0.pgm"          # odd square, its centre is the corner; beside this file or under the data
//   folder
//
// Without `axes` everything is in the world's own: x forward, y left, z up. SceneLib's (x, y, z) is (z, x, y)
// there.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/features/target.hpp"

namespace incognita {

/// Patches are looked for beside the file, then in `patch_folders`. Throws InputError naming file, line and
/// key.
Target read_target(const std::filesystem::path& file,
                   const std::vector<std::filesystem::path>& patch_folders = {});

/// The file that `start.target` names: beside the scenario, under the data folder, or built in.
std::filesystem::path find_target(const LoadedScenario& loaded);

/// The scenario's target.
Target load_target(const LoadedScenario& loaded);

}  // namespace incognita
