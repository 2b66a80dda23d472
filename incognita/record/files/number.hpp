// Numbers as text, identical on every machine: the shortest form that reads back exactly, without locale.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

namespace incognita {

/// Writes `nan` for every NaN, whatever its sign.
void append_number(std::string& text, double value);

/// Appends a comma and the number.
void append_cell(std::string& row, double value);

/// Appends a comma and the word, quoted as in RFC 4180 if it contains a comma, a quote or a line break.
void append_cell(std::string& row, std::string_view word);

/// Parses the whole text, except surrounding blanks, as one number; nullopt if it is not one.
std::optional<double> parse_number(std::string_view text);

}  // namespace incognita
