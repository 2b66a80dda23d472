// Reads whole files from the disk or from those built into the program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

/// Prefix of the paths of built-in files: "embedded:/room.toml".
inline constexpr std::string_view embedded_root = "embedded:";

bool is_embedded(const std::filesystem::path& path);

/// The path for messages, without the prefix of built-in files.
std::string shown(const std::filesystem::path& path);

/// Whether the path is a regular file.
bool file_exists(const std::filesystem::path& path);

/// The whole content. Throws InputError naming the file if it cannot be read or exceeds `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t largest);

/// Names of the built-in scenarios, without ".toml".
std::vector<std::string> embedded_scenarios();

}  // namespace incognita
