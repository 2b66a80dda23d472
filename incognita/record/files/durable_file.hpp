// A crash-safe file: after a crash of the program or the machine it holds either the old text or the new one.
#pragma once

#include <filesystem>
#include <string_view>

namespace incognita {

/// Writes to a temporary file beside the target (`.NAME.part-XXXXXX`), syncs it to the disk and renames it,
/// so a concurrent reader or writer sees either the old text or the new one. Throws RecordError.
void write_durably(const std::filesystem::path& path, std::string_view text);

/// Removes temporary files that killed writers left in the folder, if they are a minute old or more.
void remove_partial_files(const std::filesystem::path& folder);

}  // namespace incognita
