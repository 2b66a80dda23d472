// Validates the names and expressions of a system before any computation.
#pragma once

#include <string>

#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

/// Throws SystemError for the first error: an invalid, duplicate or unknown name, a state without a region, an empty
/// range, an invalid expression (expression_guard.hpp), or a limit exceeded. Missing parts have no location.
///
/// Visibility: definitions may use states, inputs, parameters and earlier definitions; equations,
/// measurements, directions and error rows may use all of these; assignments of a motion also its draws.
/// Landmark and anchor may use the vehicle's names and their own.
void check_system(const SystemText& system);

/// Location of character `offset` of an expression; of the whole text if it has several lines.
SourceLocation location_in(const ExpressionText& expression, int offset);

/// A user's name for messages: in backticks, truncated, without control characters.
std::string quoted_name(const std::string& name);

}  // namespace incognita
