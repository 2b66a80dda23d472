#include "incognita/io/formats/number_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_number_table = std::size_t{256} << 20;
constexpr std::string_view blanks = " \t\r,";

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t at = line.find_first_not_of(blanks); at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    cells.emplace_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return cells;
}

}  // namespace

const std::string& TableLine::text(std::size_t i) const {
  if (i >= cells.size()) {
    throw InputError(fmt::format("{}: has {} columns, column {} is required", where, cells.size(), i + 1));
  }
  return cells[i];
}

double TableLine::number(std::size_t i) const {
  const std::string& cell = text(i);
  double value = 0;
  const char* end = cell.data() + cell.size();
  const auto [stopped, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) {
    throw InputError(
        fmt::format("{}: column {} must be a number, and is `{}`", where, i + 1, cell.substr(0, 60)));
  }
  return value;
}

std::vector<TableLine> read_table(const std::filesystem::path& file) {
  const std::string content = read_file(file, largest_number_table);
  std::vector<TableLine> lines;
  int number = 0;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find('\n', at), content.size());
    std::vector<std::string> cells = split(std::string_view(content).substr(at, end - at));
    ++number;
    at = end + 1;
    if (cells.empty() || cells.front().front() == '#') continue;
    lines.push_back({fmt::format("{}:{}", shown(file), number), std::move(cells)});
  }
  return lines;
}

}  // namespace incognita
