// What can be done next.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace incognita {

struct Translation {
  std::string name;
  Eigen::Vector3d
      direction;  ///< unit or zero; x along the camera's heading in the horizontal plane, y left, z up
};

/// The seven translations of thesis 6.3.1.
std::vector<Translation> seven_translations();

}  // namespace incognita
