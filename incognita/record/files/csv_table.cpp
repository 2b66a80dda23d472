#include "incognita/record/files/csv_table.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/number.hpp"

namespace incognita {
namespace {

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> found(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      found.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      found.emplace_back();
    } else if (c != '\r') {
      found.back() += c;
    }
  }
  return found;
}

}  // namespace

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  const auto index = find(column);
  if (!index) throw InputError("no column `" + std::string(column) + "`");
  std::vector<double> values;
  for (const auto& row : rows)
    values.push_back(parse_number(row[*index]).value_or(std::numeric_limits<double>::quiet_NaN()));
  return values;
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be read; is this a run directory?");
  CsvTable table;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    auto row = cells(line);
    if (table.columns.empty()) {
      table.columns = std::move(row);
      continue;
    }
    if (row.size() != table.columns.size())
      throw InputError(path.string() + ":" + std::to_string(number) + ": " + std::to_string(row.size()) +
                       " columns, the header has " + std::to_string(table.columns.size()));
    table.rows.push_back(std::move(row));
  }
  if (table.columns.empty()) throw InputError(path.string() + ": empty");
  return table;
}

}  // namespace incognita
