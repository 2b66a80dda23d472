// From the text of an expression to what the computer algebra works on.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>

#include "incognita/analysis/systems/system_text.hpp"

namespace incognita {

/// Numbers are taken as they are written, as fractions: 0.1 is 1/10. Throws SystemError, at the character
/// where the text goes wrong, for anything that is not an expression in these names, and for what cannot be a
/// finite real number, as far as that shows without values.
GiNaC::ex parse_expression(const ExpressionText& text, const std::map<std::string, GiNaC::ex>& names);

/// Said of an expression that the algebra finds to have none, whatever the values.
inline constexpr const char* no_value = "has no value: a division by zero, or a function outside its domain";

}  // namespace incognita
