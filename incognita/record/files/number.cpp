#include "incognita/record/files/number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>

namespace incognita {

void append_number(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "nan";
    return;
  }
  fmt::format_to(std::back_inserter(text), "{}", value);
}

void append_cell(std::string& row, double value) {
  row += ',';
  append_number(row, value);
}

void append_cell(std::string& row, std::string_view word) {
  row += ',';
  if (word.find_first_of(",\"\r\n") == std::string_view::npos) {
    row += word;
    return;
  }
  row += '"';
  for (const char c : word) {
    if (c == '"') row += '"';
    row += c == '\n' || c == '\r' ? ' ' : c;  // keeps a row on one line
  }
  row += '"';
}

std::optional<double> parse_number(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(blank) - first + 1);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace incognita
