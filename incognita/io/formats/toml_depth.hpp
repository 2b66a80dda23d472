// Detects keys of very many parts, a.b.c.d...: the TOML library builds as many nested tables and crashes.
#pragma once

#include <optional>
#include <string_view>

namespace incognita {

inline constexpr int most_key_parts = 100;

/// Position of the dot that makes a key too deep; both counted from 1, the column in bytes.
struct DeepKey {
  int line = 0;
  int column = 0;
};

/// The first key of more than `most_key_parts` parts. The result is unspecified for invalid TOML.
std::optional<DeepKey> find_deep_key(std::string_view toml);

}  // namespace incognita
