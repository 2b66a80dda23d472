// Limits for JSON texts of files that may be damaged, and for messages about them.
#pragma once

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>

namespace incognita {

/// More than any message or file of a run has. Writing a text that is nested too deep would overflow the stack.
constexpr int most_json_depth = 32;

/// Largest number of open brackets; those in strings do not count.
inline int json_depth(std::string_view text) {
  int depth = 0, most = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') in_string = !in_string;
    if (in_string) {
      i += c == '\\';  // skips what is escaped
      continue;
    }
    if (c == '[' || c == '{') most = std::max(most, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return most;
}

/// The beginning of what an exception says: the JSON library quotes texts of any length.
inline std::string brief(const std::exception& error) { return std::string(error.what()).substr(0, 200); }

}  // namespace incognita
