// Validates user expressions before they reach the computer algebra. Anything that is not an expression is rejected
// with its location and a remedy, so the parser behind never sees bad syntax, deep nesting or long numbers.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

struct ExpressionToken {
  enum Kind {
    number,     ///< without its sign
    name,       ///< a known name, or pi
    function,   ///< its name; `open` follows
    sign,       ///< + or - before an operand
    operation,  ///< binary + - * / ^
    open,
    close,
    comma
  };
  Kind kind;
  std::string_view text;  ///< part of the given text
  int offset;             ///< position of the first character, from 0
};

struct ExpressionError : std::runtime_error {
  ExpressionError(int at, const std::string& why) : std::runtime_error(why), offset(at) {}
  int offset;  ///< position of the wrong character, from 0
};

constexpr std::size_t longest_expression = 4096;
/// Parentheses, repeated signs and powers of powers each count one level.
constexpr int deepest_expression = 100;
constexpr std::size_t longest_number = 40;
constexpr int largest_decimal_exponent = 300;

/// Tokens of an expression of + - * / ^ ( ), numbers such as 1, 1.5, .5 and 1e-3, `pi`, the functions below and the
/// names in `known`, which must be sorted. Throws ExpressionError for anything else. The tokens refer to `text`.
std::vector<ExpressionToken> checked_tokens(std::string_view text, std::span<const std::string> known);

struct ExpressionFunction {
  std::string_view name;
  int arguments;
};

std::span<const ExpressionFunction> expression_functions();

/// Whether a name is reserved: a function, `pi`, or a constant of the computer algebra.
bool is_reserved_name(std::string_view name);

}  // namespace incognita
