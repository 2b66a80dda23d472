// What can be set on the choice of the next move.
#pragma once

#include <Eigen/Core>
#include <string>

namespace incognita {

struct DecisionSettings {
  std::string strategy = "mutual-information";  ///< `mutual-information`, or `none`: stay where it started
  double step_m = 0.3;    ///< displacement of each of the seven translations, thesis 6.3.1
  double period_s = 1.0;  ///< an action lasts this long, then all are compared again
  Eigen::Vector3d min_bound_m{-1e9, -1e9, -1e9};  ///< goals outside this box of the world are not chosen
  Eigen::Vector3d max_bound_m{1e9, 1e9, 1e9};
};

}  // namespace incognita
