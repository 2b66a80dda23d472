// Generates the gnuplot scripts of a run's figures. The scripts read the run's tables; only values that
// gnuplot cannot compute, such as outlier-robust axis ranges, are computed here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Returns nullopt if the run has no data for the figure. Throws InputError if a table cannot be read.
/// `alignment` is the one used for the comparison with the truth; with `sim3`, lengths of the estimate have no unit.
using FigureScript = std::optional<std::string> (*)(const std::filesystem::path& run_directory,
                                                    AlignmentKind alignment);

/// Top view to scale in the frame of the estimate: landmarks with 2-sigma ellipses, surveyed landmarks,
/// estimated and true path.
std::optional<std::string> map_script(const std::filesystem::path& run_directory, AlignmentKind alignment);
/// Position and rotation errors with 2-sigma bounds; without truth, the bounds only.
std::optional<std::string> errors_script(const std::filesystem::path& run_directory, AlignmentKind alignment);
/// Entropies of vehicle, map and total, with a vertical line at each added landmark.
std::optional<std::string> entropy_script(const std::filesystem::path& run_directory,
                                          AlignmentKind alignment);
/// Scores of all candidates at each decision, and the chosen action.
std::optional<std::string> decision_script(const std::filesystem::path& run_directory,
                                           AlignmentKind alignment);

}  // namespace incognita
