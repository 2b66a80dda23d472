// Systems written down as TOML, from files and from those built in; docs/add-a-system.md describes the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

/// What `text` says, with nothing in it that check_system() would refuse. Throws InputError
/// ("file:line:column: what is wrong; remedy") at the first thing that is wrong.
SystemText read_system(std::string_view text, const std::string& file_name);

/// `name_or_path` is the name of a built-in system or a file. `representation` is "world", "relative", or
/// empty where any will do: what is built in may come in both (NAME and NAME-relative), a file must be as
/// asked for. Throws InputError.
SystemText load_system(const std::string& name_or_path, const std::string& representation = "");

/// Names of the systems built in.
std::vector<std::string> built_in_systems();

}  // namespace incognita
