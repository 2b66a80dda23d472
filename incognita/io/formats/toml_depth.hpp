// Keys of very many parts, a.b.c.d..., which the TOML reader turns into as many tables inside each other and
// then dies of.
#pragma once

#include <optional>
#include <string_view>

namespace incognita {

inline constexpr int most_key_parts = 100;

/// Where the dot stands that makes a key too deep; both from 1, the column in bytes.
struct DeepKey {
  int line = 0;
  int column = 0;
};

/// The first key of more than `most_key_parts` parts. Of a text that is no TOML it may say anything.
std::optional<DeepKey> find_deep_key(std::string_view toml);

}  // namespace incognita
