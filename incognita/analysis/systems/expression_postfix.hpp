// The order in which an expression is computed.
#pragma once

#include <span>
#include <vector>

#include "incognita/analysis/systems/expression_guard.hpp"

namespace incognita {

/// Of checked_tokens(), without parentheses and commas: operands before what works on them (postfix), so that
/// a stack computes them. `sign` works on one operand, `operation` on two, `function` on as many as it takes.
/// ^ comes before a sign and groups to the right, all else to the left: -x^2 is -(x^2), 2^-x^2 is 2^(-(x^2)).
///
/// GiNaC's own parser is not asked: to it a*-b - c is a*(-b - c), and a^b^c an error.
std::vector<ExpressionToken> in_postfix_order(std::span<const ExpressionToken> checked);

}  // namespace incognita
