// Folders that are made for a purpose, and go when it comes to nothing.
#pragma once

#include <filesystem>
#include <vector>

namespace incognita {

/// The folders on the way to `path`, itself included, that are not there; the outermost first.
std::vector<std::filesystem::path> missing_folders(const std::filesystem::path& path);

/// Removes those that are empty, the last first.
void remove_empty(const std::vector<std::filesystem::path>& folders) noexcept;

}  // namespace incognita
