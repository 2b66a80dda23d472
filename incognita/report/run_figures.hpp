// Draws the figures of a run with gnuplot from its tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Draws `figures/map.svg`, `errors.svg`, `entropy.svg` and `decision.svg` from the tables of a run directory;
/// for a team, also the figures of team_figures.hpp. Each has its gnuplot script beside it; `gnuplot
/// figures/map.gp` in the run directory redraws it. Figures without data (no decisions, no pose) are left
/// out. `alignment` is that of the estimate with the truth; with `sim3`, lengths have an arbitrary unit.
///
/// Returns warnings if gnuplot is missing (only the scripts are written then) or fails. Throws RecordError if
/// writing fails, without leaving a partial figure, and InputError if a table cannot be read.
std::vector<std::string> draw_run_figures(const std::filesystem::path& run_directory,
                                          AlignmentKind alignment = AlignmentKind::none);

}  // namespace incognita
