// Where recordings are: under INCOGNITA_DATA, else data/, else ../shared/data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// The folders looked into, in order. Without INCOGNITA_DATA: data/ and ../shared/data, seen from the working
/// folder and from the folder above the scenario's.
std::vector<std::filesystem::path> data_folders(const std::filesystem::path& scenario_file);

/// The first that exists of `path` under the data folders; an absolute path stands for itself.
/// Throws InputError that says, after `wanted_by`, what is missing, where it was looked for, where it is
/// published, its checksum if that is known, and where to put it.
std::filesystem::path find_data(const std::string& path, const std::filesystem::path& scenario_file,
                                const std::string& wanted_by);

}  // namespace incognita
