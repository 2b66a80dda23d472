// The figures that Examples 5.1 to 5.3 have in common, of one run each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::closed_loop {

/// True, estimated and desired paths of the robots, and their map: Figures 5.3, 5.6, 5.9.
Plot map_figure(const std::string& id, const std::string& title, const Setup& setup, const Run& run);

/// State, error within two sigmas, and commands over time; a column for each robot: Figures 5.4, 5.7, 5.10.
Plot state_figure(const std::string& id, const std::string& title, const Run& run);

/// |eigenvalues| of F - G L over time, with L by the estimated pose: Figures 5.5, 5.8.
Plot eigenvalue_figure(const std::string& id, const std::string& title, const Run& run,
                       const std::function<Eigen::Matrix2d(const planar::Pose<double>&)>& gain);

}  // namespace incognita::closed_loop
