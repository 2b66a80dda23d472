// Evaluation order of an expression.
#pragma once

#include <span>
#include <vector>

#include "incognita/analysis/systems/expression_guard.hpp"

namespace incognita {

/// Converts checked_tokens() to postfix order without parentheses and commas, for evaluation with a stack.
/// `sign` takes one operand, `operation` two, `function` its number of arguments. ^ binds tighter than a sign
/// and is right-associative, all else left-associative: -x^2 is -(x^2), 2^-x^2 is 2^(-(x^2)).
///
/// GiNaC's own parser is not used: it reads a*-b - c as a*(-b - c), and rejects a^b^c.
std::vector<ExpressionToken> in_postfix_order(std::span<const ExpressionToken> checked);

}  // namespace incognita
