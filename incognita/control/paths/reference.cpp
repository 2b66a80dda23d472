#include "incognita/control/paths/reference.hpp"

#include <algorithm>

namespace incognita {

Reference minimum_jerk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double start_t, double end_t,
                       double t) {
  if (!(end_t > start_t)) return {to, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const double T = end_t - start_t, s = std::clamp((t - start_t) / T, 0.0, 1.0), rest = 1 - s;
  const Eigen::Vector3d way = to - from;
  return {from + way * (s * s * s * (10 + s * (6 * s - 15))), way * (30 * s * s * rest * rest / T),
          way * (60 * s * rest * (1 - 2 * s) / (T * T))};
}

}  // namespace incognita
