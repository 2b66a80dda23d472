// Reads systems from TOML files and from those built in; the format is described in docs/add-a-system.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

/// Parses `text`; the result passes check_system(). Throws InputError ("file:line:column: what is wrong;
/// remedy") at the first error.
SystemText read_system(std::string_view text, const std::string& file_name);

/// `name_or_path` is a built-in system or a file. `representation` is "world", "relative" or empty for any:
/// built-in systems may exist in both (NAME and NAME-relative), a file must have the requested one. Throws
/// InputError.
SystemText load_system(const std::string& name_or_path, const std::string& representation = "");

/// Names of the built-in systems.
std::vector<std::string> built_in_systems();

}  // namespace incognita
