// Text tables whose first line names the columns: commas between, one line a row.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

/// Empty lines and comments (#) are passed over; blanks around a cell, and quotes around it, do not count.
class NamedTable {
 public:
  /// Throws InputError naming file and line when the file cannot be read, has no rows, or a row is shorter or
  /// longer than the first line.
  explicit NamedTable(const std::filesystem::path& file);

  std::size_t rows() const { return lines_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  std::string where(std::size_t row) const;              ///< "file:line", for messages
  const std::string& header() const { return header_; }  ///< the same of the first line

  std::optional<std::size_t> find(std::string_view column) const;
  /// Throws InputError that names the columns there are, and the nearest of them.
  std::size_t column(std::string_view name) const;
  /// "a.csv: columns that are not used: x, y"; empty when all columns are among those known.
  std::string unused(std::initializer_list<std::string_view> known) const;

  bool empty(std::size_t row, std::size_t column) const { return cell(row, column).empty(); }
  /// Of `nan` and `inf` too. Throws InputError when the cell is no number.
  double number(std::size_t row, std::size_t column) const;
  /// Throws InputError when the cell is no finite number.
  double finite(std::size_t row, std::size_t column) const;
  /// Detection::unknown where there is no such column or the cell is empty. Throws InputError when the cell
  /// is no whole number from 0.
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
  std::vector<int> lines_;          ///< of each row
};

}  // namespace incognita
