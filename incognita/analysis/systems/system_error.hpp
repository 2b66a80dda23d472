// What is wrong with a system as it was written down, and where.
#pragma once

#include <stdexcept>
#include <string>

#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

struct SystemError : std::runtime_error {
  SourceLocation location;
  SystemError(SourceLocation where, const std::string& what) : std::runtime_error(what), location(where) {}
};

/// Nothing is wrong with it, but it is too large for what was asked.
struct SystemTooLarge : SystemError {
  using SystemError::SystemError;
};

}  // namespace incognita
