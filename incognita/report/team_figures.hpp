// The gnuplot scripts of a team's figures, from vehicles.csv.
#pragma once

#include "incognita/report/figure_scripts.hpp"

namespace incognita {

/// Every vehicle from above: where it was to be, really was, and was believed to be; the map with 2-sigma
/// ellipses.
std::optional<std::string> vehicles_script(const std::filesystem::path& run_directory,
                                           AlignmentKind alignment);
/// How far each vehicle was from where it was to be, and what it was asked to do, over time.
std::optional<std::string> control_script(const std::filesystem::path& run_directory,
                                          AlignmentKind alignment);

}  // namespace incognita
