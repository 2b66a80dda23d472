#include "incognita/io/formats/toml_depth.hpp"

#include <algorithm>
#include <cstddef>

namespace incognita {
namespace {

/// End of the comment or quoted string that begins at `at`; `at` if there is none.
std::size_t skip_words(std::string_view toml, std::size_t at) {
  const char first = toml[at];
  if (first == '#') return std::min(toml.find('\n', at), toml.size());
  if (first != '"' && first != '\'') return at;
  const bool long_text = toml.substr(at, 3) == std::string_view(first == '"' ? "\"\"\"" : "'''");
  const std::string_view end = toml.substr(at, long_text ? 3 : 1);
  for (std::size_t i = at + end.size(); i < toml.size(); ++i) {
    if (first == '"' && toml[i] == '\\') {
      ++i;
    } else if (toml.substr(i, end.size()) == end) {
      return i + end.size();
    } else if (!long_text && toml[i] == '\n') {
      return i;  // unterminated: reported by the parser
    }
  }
  return toml.size();
}

/// Characters of a dotted key outside of quoted strings.
bool in_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ' ' || c == '\t' || c == '.';
}

}  // namespace

std::optional<DeepKey> find_deep_key(std::string_view toml) {
  int line = 1, parts = 1;
  std::size_t line_begin = 0, at = 0;
  while (at < toml.size()) {
    const std::size_t after = skip_words(toml, at);
    if (after == at) {
      if (toml[at] == '.' && ++parts > most_key_parts)
        return DeepKey{line, static_cast<int>(at - line_begin) + 1};
      if (!in_key(toml[at])) parts = 1;
    }
    const std::size_t next = std::max(after, at + 1);
    for (; at < next; ++at) {
      if (toml[at] != '\n') continue;
      ++line;
      line_begin = at + 1;
    }
  }
  return std::nullopt;
}

}  // namespace incognita
