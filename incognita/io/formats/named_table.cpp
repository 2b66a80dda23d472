#include "incognita/io/formats/named_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "incognita/io/formats/files.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_table = std::size_t{256} << 20;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// Appends the cells of a line and returns their number.
std::size_t split(std::string_view line, std::vector<std::string>& cells) {
  std::size_t count = 1;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; ++count) {
    cells.emplace_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(comma + 1);
  }
  cells.emplace_back(trimmed(line));
  return count;
}

}  // namespace

NamedTable::NamedTable(const std::filesystem::path& file) : file_(shown(file)) {
  const std::string content = read_file(file, largest_table);
  std::string_view rest = content;
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    if (columns_.empty()) {
      read_header(line, number);
    } else {
      read_row(line, number);
    }
  }
  if (columns_.empty()) throw InputError(file_ + ": is empty; its first line must name the columns");
  if (lines_.empty()) throw InputError(file_ + ": there are no rows below the column names");
}

void NamedTable::read_header(std::string_view line, int number) {
  split(line, columns_);
  header_ = fmt::format("{}:{}", file_, number);
  for (auto name = columns_.begin(); name != columns_.end(); ++name) {
    if (!name->empty() && std::find(columns_.begin(), name, *name) != name) {
      throw InputError(fmt::format("{}: there are two columns `{}`", header_, name->substr(0, 60)));
    }
  }
}

void NamedTable::read_row(std::string_view line, int number) {
  const std::size_t count = split(line, cells_);
  if (count != columns_.size()) {
    throw InputError(fmt::format("{}:{}: has {} cells, the first line names {} columns", file_, number, count,
                                 columns_.size()));
  }
  lines_.push_back(number);
}

std::string NamedTable::where(std::size_t row) const { return fmt::format("{}:{}", file_, lines_[row]); }

std::optional<std::size_t> NamedTable::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t NamedTable::column(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  const std::string there = fmt::format("{}", fmt::join(columns_, ", "));
  throw InputError(fmt::format("{}: there is no column `{}`; the columns are {}; the nearest is `{}`",
                               header_, name, there.substr(0, 400),
                               nearest_name(name, columns_).substr(0, 60)));
}

std::string NamedTable::unused(std::initializer_list<std::string_view> known) const {
  std::vector<std::string> others;
  std::copy_if(columns_.begin(), columns_.end(), std::back_inserter(others), [&](const std::string& column) {
    return std::find(known.begin(), known.end(), column) == known.end();
  });
  if (others.empty()) return "";
  return fmt::format("{}: unused columns: {}", file_, fmt::join(others, ", "));
}

double NamedTable::number(std::size_t row, std::size_t column) const {
  const std::string& text = cell(row, column);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stopped == end) return value;
  throw InputError(fmt::format("{}: `{}` must be a number, and is `{}`", where(row), columns_[column],
                               text.substr(0, 60)));
}

double NamedTable::finite(std::size_t row, std::size_t column) const {
  const double value = number(row, column);
  if (std::isfinite(value)) return value;
  throw InputError(
      fmt::format("{}: `{}` must be a finite number, and is {}", where(row), columns_[column], value));
}

std::int64_t NamedTable::identity(std::size_t row, std::optional<std::size_t> column) const {
  if (!column || empty(row, *column)) return Detection::unknown;
  const std::string& text = cell(row, *column);
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stopped == end && value >= 0) return value;
  throw InputError(
      fmt::format("{}: `{}` must be a whole number from 0, and is `{}`; leave it empty if it is unknown",
                  where(row), columns_[*column], text.substr(0, 60)));
}

}  // namespace incognita
