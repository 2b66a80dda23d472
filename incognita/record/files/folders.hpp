// Folders created for one purpose and removed when it fails.
#pragma once

#include <filesystem>
#include <vector>

namespace incognita {

/// The folders on the way to `path`, including `path`, that do not exist yet; outermost first.
std::vector<std::filesystem::path> missing_folders(const std::filesystem::path& path);

/// Removes the empty ones among `folders`, last first.
void remove_empty(const std::vector<std::filesystem::path>& folders) noexcept;

}  // namespace incognita
