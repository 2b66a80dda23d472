// Parses expressions for the computer algebra.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>

#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

/// Numbers are read exactly, as fractions: 0.1 is 1/10. Throws SystemError, with the location of the wrong
/// character, for anything that is not an expression in these names, and for expressions without a finite
/// real value, as far as that is visible without numbers.
GiNaC::ex parse_expression(const ExpressionText& text, const std::map<std::string, GiNaC::ex>& names);

/// Message for an expression that is undefined for all values.
inline constexpr const char* no_value = "has no value: a division by zero, or a function outside its domain";

}  // namespace incognita
