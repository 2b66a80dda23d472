// Runs gnuplot and quotes text for its scripts.
#pragma once

#include <filesystem>
#include <string>

namespace incognita {

/// Runs `figures/NAME.gp` in a folder, which draws `figures/NAME.svg`. Returns an empty string, or a warning
/// if gnuplot is missing or failed; there is no picture then. Throws RecordError if writing fails, without
/// leaving a partial figure.
std::string draw_script(const std::filesystem::path& folder, const std::string& name);

/// Text as a quoted gnuplot string. Nothing in it can act as a command; characters that would break the line
/// become blanks.
std::string gnuplot_string(const std::string& words);

}  // namespace incognita
