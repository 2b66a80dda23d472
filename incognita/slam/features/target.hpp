// A known target: small patches of known appearance at known places. It fixes where the world is and its
// scale.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

struct Target {
  struct Corner {
    Eigen::Vector3d position;  ///< world, m, z up
    Image patch;               ///< odd square, its centre pixel is the corner
  };
  /// The whole target and what is around it, taken straight on from its printed side.
  struct Picture {
    Image image;
    Eigen::Matrix3d world_from_px;  ///< m of (u, v, 1): a pixel to the right, one down, where (0, 0) is
  };
  std::string name;
  std::vector<Corner> corners;      ///< four or more, in one plane
  Eigen::Vector3d normal{0, 0, 1};  ///< unit, world, pointing out of the printed side
  std::optional<Picture> picture;   ///< without it nothing but the corners can be recognised
};

}  // namespace incognita
