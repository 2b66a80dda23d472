#include "incognita/record/mcap/json_vectors.hpp"

#include <nlohmann/json.hpp>

namespace incognita {

nlohmann::ordered_json xyz(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

nlohmann::ordered_json quaternion(const Eigen::Vector4d& wxyz) {
  return {{"x", wxyz[1]}, {"y", wxyz[2]}, {"z", wxyz[3]}, {"w", wxyz[0]}};
}

}  // namespace incognita
