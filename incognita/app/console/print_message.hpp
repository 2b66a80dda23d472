// What the program tells a person, on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace incognita {

/// Prints, or does not: a terminal that is gone or a log on a full disk is no reason to end a run.
template <class... T>
void print_message(fmt::format_string<T...> format, T&&... arguments) {
  const std::string text = fmt::format(format, std::forward<T>(arguments)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace incognita
