// A file that is there whole or not at all, whatever happens to the program or the machine.
#pragma once

#include <filesystem>
#include <string_view>

namespace incognita {

/// Writes beside the file under a name of its own (`.NAME.part-XXXXXX`), waits until the disk has it, and
/// renames: another reader or writer sees the old text or the new one. Throws RecordError.
void write_durably(const std::filesystem::path& path, std::string_view text);

/// Removes what writers that were killed left in the folder: such names, a minute old or more.
void remove_partial_files(const std::filesystem::path& folder);

}  // namespace incognita
