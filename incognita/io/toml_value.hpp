// A TOML document as plain values that remember their lines. Everything else of the TOML reader stays in one
// file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace incognita {

struct TomlValue;
struct TomlEntry;
struct TomlDate {};  ///< dates and times: no setting is one
using TomlArray = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;  ///< in the order of the file's lines

struct TomlValue {
  std::variant<TomlDate, std::string, std::int64_t, double, bool, TomlArray, TomlTable> value;
  int line = 0;

  /// As it would be written, cut short when long: for messages.
  std::string written() const;
  /// "a text", "a whole number", ...
  std::string kind() const;
};

struct TomlEntry {
  std::string key;
  int line = 0;
  TomlValue value;
};

/// Throws InputError("file:line: ...") on anything that is not TOML or is larger than 1 MiB.
TomlTable parse_toml(std::string_view text, const std::string& file_name);

/// A text as TOML writes it, in quotes.
std::string toml_string(std::string_view text);
/// The shortest TOML number that reads back as the same value, always with a point or an exponent.
std::string toml_number(double value);

}  // namespace incognita
