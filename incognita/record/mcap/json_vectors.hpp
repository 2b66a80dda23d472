// Vectors and quaternions in the layout of Foxglove's messages.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

namespace incognita {

nlohmann::ordered_json xyz(const Eigen::Vector3d& v);
nlohmann::ordered_json quaternion(const Eigen::Vector4d& wxyz);

}  // namespace incognita
