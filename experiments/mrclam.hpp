// The drives of the recorded team that are compared, and their figures.
#pragma once

#include <string>
#include <vector>

#include "experiments/recorded_team.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::recorded_team {

/// Each robot alone, with four filters.
struct Alone {
  std::vector<Drive> plain, iterated, plain_own_times, iterated_own_times;
  std::vector<const std::vector<Drive>*> all() const {
    return {&plain, &iterated, &plain_own_times, &iterated_own_times};
  }
};
Alone drive_alone(const Robots& robots, const Setup& setup);

/// With the noises as fixed.
struct Drives {
  Drive joint, joint_iterated, shared_map;
  Alone alone;
};
Drives compare(const Robots& robots);

using Number = double RobotCourse::*;
std::vector<double> of_robots(const Drive& drive, Number what);
std::vector<double> of_robots(const std::vector<Drive>& alone, Number what);
/// For each robot, and for its map, the least over the four.
std::vector<double> best_robots(const Alone& alone, Number what);
std::vector<double> best_maps(const Alone& alone, double Drive::*what);
std::vector<Plot> figures(const Drives& drives);

}  // namespace incognita::recorded_team
