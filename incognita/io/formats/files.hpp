// Reading whole files, from the disk or from those that are built into the program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

/// Paths of files built into the program begin with this: "embedded:/room.toml".
inline constexpr std::string_view embedded_root = "embedded:";

bool is_embedded(const std::filesystem::path& path);

/// How a path is shown to a person: without the mark of a built-in file.
std::string shown(const std::filesystem::path& path);

/// Whether a regular file is there.
bool file_exists(const std::filesystem::path& path);

/// The whole content. Throws InputError naming the file when it cannot be read or has more than `largest`
/// bytes.
std::string read_file(const std::filesystem::path& path, std::size_t largest);

/// Names of the scenarios built in, without ".toml".
std::vector<std::string> embedded_scenarios();

}  // namespace incognita
