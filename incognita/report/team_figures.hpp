// Generates the gnuplot scripts of a team's figures from vehicles.csv.
#pragma once

#include "incognita/report/figure_scripts.hpp"

namespace incognita {

/// Top view of reference, true and estimated path of every vehicle, and the map with 2-sigma ellipses.
std::optional<std::string> vehicles_script(const std::filesystem::path& run_directory,
                                           AlignmentKind alignment);
/// Distance of each vehicle from its reference, and its inputs, over time.
std::optional<std::string> control_script(const std::filesystem::path& run_directory,
                                          AlignmentKind alignment);

}  // namespace incognita
