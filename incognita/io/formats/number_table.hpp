// Lines of a text table, split at white space or commas, with their line numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

struct TableLine {
  std::string where;  ///< "file:line", for messages
  std::vector<std::string> cells;

  /// Throws InputError unless cell i exists and is a finite number.
  double number(std::size_t i) const;
  /// Throws InputError unless cell i exists.
  const std::string& text(std::size_t i) const;
};

/// All lines except empty ones and comments (#). Throws InputError if the file cannot be read.
std::vector<TableLine> read_table(const std::filesystem::path& file);

}  // namespace incognita
