// Matrices of numbers from MAT files of level 5, as MATLAB and Octave write them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace incognita {

/// The variables of these names, of whatever type of number, as double. Throws InputError naming the file and
/// the variable when one is missing, is no matrix of real numbers, or the file is cut short or damaged.
std::map<std::string, Eigen::MatrixXd> read_mat_numbers(const std::filesystem::path& file,
                                                        const std::vector<std::string>& names);

}  // namespace incognita
