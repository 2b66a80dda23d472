// Deterministic small mutations of a file.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "incognita/math/random.hpp"

namespace incognita::testing {

/// One to four bytes changed, deleted, inserted or repeated; sometimes the rest is truncated.
inline std::string damaged(std::string text, RandomStream& random) {
  static constexpr const char* words[] = {
      "nan", "-inf", "1e999", "-", "[", "\"", "\n", "99999999999999999999", ","};
  for (int n = 1 + random.below(4); n > 0 && !text.empty(); --n) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
    switch (random.below(6)) {
      case 0:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        text.erase(at, 1 + static_cast<std::size_t>(random.below(8)));
        break;
      case 2:
        text.insert(at, words[random.below(std::size(words))]);
        break;
      case 3:
        text.insert(at, text.substr(at, 20));
        break;
      case 4:
        text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
        break;
      default:
        if (random.below(8) == 0) text.resize(at);
    }
  }
  return text;
}

/// Number of mutated files that were accepted. `read` may throw what a reader may.
inline int still_read(const std::string& whole, int times,
                      const std::function<void(const std::string&)>& read) {
  RandomStream random(1, "damage");
  int fine = 0;
  for (int i = 0; i < times; ++i) {
    const std::string text = damaged(whole, random);
    try {
      read(text);
      ++fine;
    } catch (const std::runtime_error& error) {  // includes InputError
      EXPECT_FALSE(std::string(error.what()).empty());
    }
  }
  return fine;
}

}  // namespace incognita::testing
