// Reads a table of a run directory by column name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each with as many cells as `columns`

  std::optional<std::size_t> find(std::string_view column) const;
  /// The cells of a column, NaN where a cell is not a number. Throws InputError if the column does not exist.
  std::vector<double> numbers(std::string_view column) const;
};

/// Comma-separated, quoted as in RFC 4180, one row per line. Throws InputError naming file, line and problem.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace incognita
