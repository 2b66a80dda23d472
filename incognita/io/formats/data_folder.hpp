// Locates recordings: under INCOGNITA_DATA, else data/, else ../shared/data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// The folders to search, in order. Without INCOGNITA_DATA: data/ and ../shared/data, relative to the working
/// folder and to the parent of the scenario's folder.
std::vector<std::filesystem::path> data_folders(const std::filesystem::path& scenario_file);

/// Adds a file or folder to those to search, unless it is one of them by another path.
void add_place(const std::filesystem::path& place, std::vector<std::filesystem::path>& places);

/// `path` beside the scenario, else the first existing one under the data folders; an absolute path is used as it is. Throws InputError
/// beginning with `wanted_by` that states what is missing, where it was searched, where it is published, its
/// checksum if known, and where to put it.
std::filesystem::path find_data(const std::string& path, const std::filesystem::path& scenario_file,
                                const std::string& wanted_by);

}  // namespace incognita
