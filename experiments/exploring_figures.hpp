// Panels and plots of exploring runs: Figures 6.4, 6.5, 6.7, 6.9, 6.10 and 6.13.
#pragma once

#include <string>
#include <vector>

#include "experiments/curves.hpp"
#include "experiments/exploring_comparison.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::exploring {

/// Entropy of the camera, the map, and all; points where landmarks were located: of Figures 6.4, 6.7 and 6.9.
Panel entropies(const std::string& title, const Run& run);
/// The path with the final map, from above.
Panel from_above(const std::string& title, const Run& run);
/// The chosen actions over time.
Panel choices(const std::string& title, const Run& run);
/// A number of every instant.
template <class F>
Curve over_time(const std::string& label, const Run& run, Color color, const F& f,
                Style style = Style::line) {
  return curve_of(label, style, color, run.instants, &Instant::t_s, f);
}

/// Paths, final maps and entropies of the first seed; a column for each strategy: Figures 6.4 and 6.9.
Plot map_figure(const std::string& id, const std::string& title, const std::vector<Runs>& runs);
/// Errors of position and orientation with their bounds, likewise: Figures 6.5 and 6.10.
Plot error_figure(const std::string& id, const std::string& title, const std::vector<Runs>& runs);

}  // namespace incognita::exploring
