// Errors in the description of a system, with their location.
#pragma once

#include <stdexcept>
#include <string>

#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

struct SystemError : std::runtime_error {
  SourceLocation location;
  SystemError(SourceLocation where, const std::string& what) : std::runtime_error(what), location(where) {}
};

/// The system is valid, but too large for the requested analysis.
struct SystemTooLarge : SystemError {
  using SystemError::SystemError;
};

}  // namespace incognita
