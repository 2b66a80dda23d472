// The gnuplot scripts of a run's figures. Scripts read the run's tables; only what gnuplot cannot work out
// itself, such as ranges that no outlier spoils, is computed here and written into them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Each gives nothing when the run has nothing to draw there. Throws InputError when a table cannot be read.
/// `alignment` is what the truth is compared after: with `sim3` the lengths of the estimate have no known
/// unit.
using FigureScript = std::optional<std::string> (*)(const std::filesystem::path& run_directory,
                                                    AlignmentKind alignment);

/// Landmarks from above with 2-sigma ellipses, estimated and true path, surveyed landmarks, to scale, in the
/// frame of the estimate.
std::optional<std::string> map_script(const std::filesystem::path& run_directory, AlignmentKind alignment);
/// Position and rotation errors in their 2-sigma bounds; without truth, the bounds.
std::optional<std::string> errors_script(const std::filesystem::path& run_directory, AlignmentKind alignment);
/// Entropies of vehicle, map and both, with a line where a landmark was added.
std::optional<std::string> entropy_script(const std::filesystem::path& run_directory,
                                          AlignmentKind alignment);
/// Every candidate's score at each decision, and the action chosen.
std::optional<std::string> decision_script(const std::filesystem::path& run_directory,
                                           AlignmentKind alignment);

}  // namespace incognita
