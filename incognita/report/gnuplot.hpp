// What every figure needs of gnuplot: it drawn, and words that it takes for words.
#pragma once

#include <filesystem>
#include <string>

namespace incognita {

/// Runs `figures/NAME.gp` in a folder, which draws `figures/NAME.svg`. Nothing, or a warning: that gnuplot is
/// missing, or what it complained of; then there is no picture. Throws RecordError when the disk refuses,
/// with no half figure left.
std::string draw_script(const std::filesystem::path& folder, const std::string& name);

/// Words as a string of a gnuplot script, quotes included. Nothing in them is ever taken for a command; what
/// would would break the line becomes a blank.
std::string gnuplot_string(const std::string& words);

}  // namespace incognita
