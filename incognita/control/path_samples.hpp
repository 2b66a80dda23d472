// Places at given times, as a file or a planner gives them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace incognita {

struct PathSamples {
  std::vector<double> t;                  ///< s, each later than the one before
  std::vector<Eigen::Vector3d> position;  ///< m, as many as times
  std::vector<double> heading;  ///< rad, as many as times; empty where the direction of travel will do
};

}  // namespace incognita
