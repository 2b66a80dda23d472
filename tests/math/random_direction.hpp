#pragma once

#include <Eigen/Core>

#include "incognita/math/random.hpp"

namespace incognita {

inline Eigen::Vector3d random_direction(RandomStream& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

}  // namespace incognita
