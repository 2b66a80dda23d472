// A known target: small patches of known appearance at known places. It fixes where the world is and its
// scale.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

struct Target {
  struct Corner {
    Eigen::Vector3d position;  ///< world, m, z up
    Image patch;               ///< odd square, its centre pixel is the corner
  };
  std::string name;
  std::vector<Corner> corners;      ///< four or more, in one plane
  Eigen::Vector3d normal{0, 0, 1};  ///< unit, world, pointing out of the printed side
};

}  // namespace incognita
