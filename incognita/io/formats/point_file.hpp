// Landmarks of a simulated place from a table: id, x, y and, if there, z (m). Other columns are not used, so
// that a run's map.csv is one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>

namespace incognita {

/// Throws InputError naming file and line: no such column, an id that is no whole number or there twice, a
/// coordinate that is not finite or beyond 1000 km.
std::map<std::int64_t, Eigen::Vector3d> read_points(const std::filesystem::path& file);

}  // namespace incognita
