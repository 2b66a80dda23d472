// Whether a system's names and expressions fit together, before anything is computed with it.
#pragma once

#include <string>

#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

/// Throws SystemError at the first thing that is wrong: a name that is none, is taken or is not there, a
/// state without a region, an empty range, an expression that is none (expression_guard.hpp), too much of
/// anything. What is missing altogether has no place.
///
/// Who sees what: definitions see states, inputs, parameters and the definitions before them; equations,
/// measurements, directions and error rows see all of these; assignments of a motion see its draws as well.
/// Landmark and anchor see the vehicle's names and their own.
void check_system(const SystemText& system);

/// Of the character `offset` of an expression; of the text as a whole when it has several lines.
SourceLocation location_in(const ExpressionText& expression, int offset);

/// In backticks, cut short and without control characters, whatever a file calls it: for messages.
std::string quoted_name(const std::string& name);

}  // namespace incognita
