// Reads numeric matrices from level-5 MAT files, as written by MATLAB and Octave.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace incognita {

/// The variables of these names, of any numeric type, as double. Throws InputError naming file and variable
/// if one is missing or not a real matrix, or if the file is truncated or damaged.
std::map<std::string, Eigen::MatrixXd> read_mat_numbers(const std::filesystem::path& file,
                                                        const std::vector<std::string>& names);

}  // namespace incognita
