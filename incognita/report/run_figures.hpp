// The figures of a run, drawn by gnuplot from what the run recorded.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Draws `figures/map.svg`, `errors.svg`, `entropy.svg` and `advice.svg` from the tables in a run directory.
/// Each has its gnuplot script beside it; `gnuplot figures/map.gp` in the run directory draws it again. What
/// there is nothing to draw for (no decision was taken, no pose was known) is left out. `alignment` is that
/// of the estimate with the truth; with `sim3` lengths have an arbitrary unit.
///
/// Returns warnings: that gnuplot is missing (then only the scripts are there), or what it complained of.
/// Throws RecordError when the disk refuses, with no half figure left, and InputError when a table cannot be
/// read.
std::vector<std::string> draw_run_figures(const std::filesystem::path& run_directory,
                                          AlignmentKind alignment = AlignmentKind::none);

}  // namespace incognita
