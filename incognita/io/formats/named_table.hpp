// Comma-separated text tables with column names in the first line, one row per line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

/// Empty lines and comments (#) are skipped; blanks and quotes around a cell are removed.
class NamedTable {
 public:
  /// Throws InputError naming file and line if the file cannot be read, has no rows, or a row has not as many
  /// cells as the header.
  explicit NamedTable(const std::filesystem::path& file);

  std::size_t rows() const { return lines_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  std::string where(std::size_t row) const;              ///< "file:line", for messages
  const std::string& header() const { return header_; }  ///< "file:line" of the first line

  std::optional<std::size_t> find(std::string_view column) const;
  /// Throws InputError with the existing columns and the nearest one.
  std::size_t column(std::string_view name) const;
  /// "a.csv: columns that are not used: x, y"; empty if all columns are known.
  std::string unused(std::initializer_list<std::string_view> known) const;

  bool empty(std::size_t row, std::size_t column) const { return cell(row, column).empty(); }
  /// Accepts `nan` and `inf`. Throws InputError if the cell is not a number.
  double number(std::size_t row, std::size_t column) const;
  /// Throws InputError if the cell is not a finite number.
  double finite(std::size_t row, std::size_t column) const;
  /// Detection::unknown if there is no such column or the cell is empty. Throws InputError if the cell is not
  /// a nonnegative integer.
  std::int64_t identity(std::size_t row, std::optional<std::size_t> column) const;

 private:
  void read_header(std::string_view line, int number);
  void read_row(std::string_view line, int number);
  const std::string& cell(std::size_t row, std::size_t column) const {
    return cells_[row * columns_.size() + column];
  }

  std::string file_;
  std::string header_;
  std::vector<std::string> columns_;
  std::vector<std::string> cells_;  ///< row by row
  std::vector<int> lines_;          ///< line number of each row
};

}  // namespace incognita
