// Reads a path from a table of samples.
//
//   t,x,y,z,heading
//   0,0,0,0.8,0
//   1.5,0.4,0.1,0.8,0.2
//
// t in s, increasing; x, y, z in m, z up; heading in rad about z from +x. The columns z (default 0) and
// heading are optional, and the order of the columns is free.
#pragma once

#include <filesystem>

#include "incognita/control/paths/path_samples.hpp"

namespace incognita {

/// Throws InputError naming file, line and remedy.
PathSamples read_path(const std::filesystem::path& file);

}  // namespace incognita
