// A known target: small patches of known appearance at known positions. It defines world frame and scale.
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
    Image patch;               ///< odd square, the corner is its center pixel
  };
  /// A frontal picture of the target and its surroundings, from the printed side.
  struct Picture {
    Image image;
    Eigen::Matrix3d world_from_px;  ///< m, from (u, v, 1); columns: pixel right, pixel down, origin
  };
  std::string name;
  std::vector<Corner> corners;      ///< four or more, in one plane
  Eigen::Vector3d normal{0, 0, 1};  ///< unit, world, pointing out of the printed side
  std::optional<Picture> picture;   ///< without it only the corners can be recognized
};

}  // namespace incognita
