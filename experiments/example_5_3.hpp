// What Section 5.2.1 claims of a team, by file: its equations, its estimate, its map.
#pragma once

#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "incognita/report/experiment.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::section_5_3 {

/// Two robots, each from the center of its circle of 5 m.
closed_loop::Setup two_circles();

/// (5.20)-(5.23): law and closed loop.
std::vector<Claim> equation_claims();
/// (5.18), (5.19), and what can be observed at all.
std::vector<Claim> estimation_claims();

/// Traces of the landmarks' covariances, by identity, in the limit of a filter without spurious information:
/// the shape of the map is known, and its frame as well as the starts determine it, by their priors and by
/// their measurements in that map. m^2.
std::vector<double> least_traces(const closed_loop::Setup& setup);

/// Figure 5.11, by runs of two_circles().
std::vector<Claim> map_claims(const ExperimentSettings& settings, const std::vector<closed_loop::Run>& runs);
Plot traces_figure(const closed_loop::Run& run);

}  // namespace incognita::section_5_3
