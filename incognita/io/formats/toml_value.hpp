// TOML documents as plain values with their positions; hides the TOML library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "incognita/messages/errors.hpp"

namespace incognita {

struct TomlValue;
struct TomlEntry;
struct TomlDate {};  ///< dates and times, which no setting uses
using TomlArray = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;  ///< in file order

struct TomlValue {
  std::variant<TomlDate, std::string, std::int64_t, double, bool, TomlArray, TomlTable> value;
  int line = 0;    ///< start position from 1; columns count characters, not bytes
  int column = 0;  ///< for a string: that of its opening quote
  /// Column of the first character of a single-line string without escapes; for other strings equal to
  /// `column`, since their content differs from the source text.
  int text_column = 0;

  /// The value in TOML syntax, truncated if long: for messages.
  std::string written() const;
  /// "a text", "a whole number", ...
  std::string kind() const;
};

struct TomlEntry {
  std::string key;
  int line = 0;
  int column = 0;  ///< position of the key
  TomlValue value;
};

/// An error with line and column.
struct TomlError : InputError {
  TomlError(const std::string& file, int at_line, int at_column, const std::string& why);
  int line, column;
  std::string reason;
};

/// Throws TomlError for invalid TOML, InputError("file: ...") for more than 1 MiB.
TomlTable parse_toml(std::string_view text, const std::string& file_name);

/// A string in TOML syntax, with quotes.
std::string toml_string(std::string_view text);
/// The shortest TOML number that reads back exactly, always with a point or an exponent.
std::string toml_number(double value);

}  // namespace incognita
