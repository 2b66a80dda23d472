// Reads point landmarks from a table with columns id, x, y and optionally z (m). Other columns are ignored,
// so that the map.csv of a run can be used.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>

namespace incognita {

/// Throws InputError naming file and line for a missing column, an id that is duplicate or not an integer,
/// and a coordinate that is not finite or beyond 1000 km.
std::map<std::int64_t, Eigen::Vector3d> read_points(const std::filesystem::path& file);

}  // namespace incognita
