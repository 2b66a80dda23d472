// A table of a run directory, read back by column name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

  std::optional<std::size_t> find(std::string_view column) const;
  /// NaN where a cell is not a number. Throws InputError when there is no such column.
  std::vector<double> numbers(std::string_view column) const;
};

/// Commas between, quotes as in RFC 4180, one line a row. Throws InputError naming file, line and what is
/// wrong.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace incognita
