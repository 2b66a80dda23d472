// Numbers as text, the same bytes everywhere: shortest form that reads back exactly, no locale.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

namespace incognita {

/// `nan` for every NaN, whatever its sign.
void append_number(std::string& text, double value);

/// A comma, and the number.
void append_cell(std::string& row, double value);

/// A comma, and the word, quoted as RFC 4180 wants where it holds a comma, a quote or a line break.
void append_cell(std::string& row, std::string_view word);

/// The number that the whole text is, blanks around it aside; nothing when it is not one.
std::optional<double> parse_number(std::string_view text);

}  // namespace incognita
