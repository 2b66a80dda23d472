// A TOML document as plain values that remember their places. Everything else of the TOML reader stays in one
// file.
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
struct TomlDate {};  ///< dates and times: no setting is one
using TomlArray = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;  ///< in the order of the file

struct TomlValue {
  std::variant<TomlDate, std::string, std::int64_t, double, bool, TomlArray, TomlTable> value;
  int line = 0;    ///< where it begins, from 1; columns count characters, not bytes
  int column = 0;  ///< of a text: that of its opening quote
  /// Of the first character of a text that is written on one line and without escapes; of any other text
  /// `column`, as what it says and what is written differ.
  int text_column = 0;

  /// As it would be written, cut short when long: for messages.
  std::string written() const;
  /// "a text", "a whole number", ...
  std::string kind() const;
};

struct TomlEntry {
  std::string key;
  int line = 0;
  int column = 0;  ///< both of the key
  TomlValue value;
};

/// What says "file:line: ..." also knows the column.
struct TomlError : InputError {
  TomlError(const std::string& file, int at_line, int at_column, const std::string& why);
  int line, column;
  std::string reason;
};

/// Throws TomlError on anything that is not TOML, InputError("file: ...") on more than 1 MiB.
TomlTable parse_toml(std::string_view text, const std::string& file_name);

/// A text as TOML writes it, in quotes.
std::string toml_string(std::string_view text);
/// The shortest TOML number that reads back as the same value, always with a point or an exponent.
std::string toml_number(double value);

}  // namespace incognita
