// Positions at given times, as from a file or a planner.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace incognita {

struct PathSamples {
  std::vector<double> t;                  ///< s, strictly increasing
  std::vector<Eigen::Vector3d> position;  ///< m, one per time
  std::vector<double> heading;            ///< rad, one per time; empty: the direction of travel
};

}  // namespace incognita
