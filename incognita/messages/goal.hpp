// Which action, which way, and what every candidate would have taught.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace incognita {

struct Goal {
  std::vector<double> scores;  ///< nats of information, one per action, of this frame
  int chosen = -1;             ///< index of the action in force; -1 before the first decision and when lost
  bool decided = false;        ///< whether it was chosen in this very frame
  Eigen::Vector3d from{0, 0, 0};  ///< world, m: where the action starts
  Eigen::Vector3d to{0, 0, 0};    ///< and where it is to end
  double start_t = 0;             ///< s
  double end_t = 0;
  std::vector<Eigen::Vector4d> team = {};  ///< x, y, z (m) and heading (rad) each vehicle is to go to
};

}  // namespace incognita
