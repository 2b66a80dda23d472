// Section 6.3, a camera that explores a room of points: what its parts share.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/exploring_run.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::exploring_room {

/// A way to choose where to go and where to look.
struct Strategy {
  std::string name;
  exploring::Sets sets;
};

/// (i), (ii), (iii) of the thesis, in their order.
const std::vector<Strategy>& thesis_strategies();

/// Runs of one strategy, by seed.
using Runs = std::vector<exploring::Run>;

/// Paths, final maps and entropies of the first seed; a column for each strategy: Figure 6.4.
Plot map_figure(const std::vector<Runs>& of_strategies);
/// Errors of position and orientation with their bounds, likewise: Figure 6.5.
Plot error_figure(const std::vector<Runs>& of_strategies);

}  // namespace incognita::exploring_room
