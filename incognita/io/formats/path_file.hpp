// Paths from a table of samples.
//
//   t,x,y,z,heading
//   0,0,0,0.8,0
//   1.5,0.4,0.1,0.8,0.2
//
// t in s, rising; x, y and z in m, z up; heading in rad about z from +x. z (0 when left out) and heading may
// be left out, and the order of the columns is free.
#pragma once

#include <filesystem>

#include "incognita/control/path_samples.hpp"

namespace incognita {

/// Throws InputError naming file and line, and what would be right.
PathSamples read_path(const std::filesystem::path& file);

}  // namespace incognita
