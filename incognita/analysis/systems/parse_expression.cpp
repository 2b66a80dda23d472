#include "incognita/analysis/systems/parse_expression.hpp"

#include <vector>

#include "incognita/analysis/systems/expression_guard.hpp"
#include "incognita/analysis/systems/expression_postfix.hpp"
#include "incognita/analysis/systems/system_check.hpp"
#include "incognita/analysis/systems/system_error.hpp"

namespace incognita {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// Exact fraction, so that 0.3 - 3*0.1 is 0.
numeric number_of(const std::string& text) {
  const std::size_t e = text.find_first_of("eE");
  std::string digits = text.substr(0, e);
  long exponent = e == std::string::npos ? 0 : std::stol(text.substr(e + 1));
  const std::size_t point = digits.find('.');
  if (point != std::string::npos) {
    exponent -= static_cast<long>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  const numeric whole(digits.c_str());
  return whole * GiNaC::pow(numeric(10), numeric(exponent));
}

/// Size of a fraction in bits.
double bits_of(const numeric& n) { return n.numer().int_length() + n.denom().int_length(); }

/// Rejects huge powers of numbers before they are computed: 9^9^9^9 would exhaust the memory.
void refuse_huge(const ex& base, const ex& exponent) {
  constexpr double most_bits = 4096;
  if (!GiNaC::is_a<numeric>(exponent)) return;
  const numeric by = abs(GiNaC::ex_to<numeric>(exponent));
  if (bits_of(by) > 64) throw std::domain_error("an exponent of more than 19 digits");
  if (GiNaC::is_a<numeric>(base) && bits_of(GiNaC::ex_to<numeric>(base)) * by.to_double() > most_bits)
    throw std::domain_error("a power of numbers with more than a thousand digits");
}

ex called(const std::string& name, const ex& a) {
  static const std::map<std::string, ex (*)(const ex&)> functions{
      {"sin", [](const ex& x) -> ex { return GiNaC::sin(x); }},
      {"cos", [](const ex& x) -> ex { return GiNaC::cos(x); }},
      {"tan", [](const ex& x) -> ex { return GiNaC::tan(x); }},
      {"asin", [](const ex& x) -> ex { return GiNaC::asin(x); }},
      {"acos", [](const ex& x) -> ex { return GiNaC::acos(x); }},
      {"atan", [](const ex& x) -> ex { return GiNaC::atan(x); }},
      {"exp", [](const ex& x) -> ex { return GiNaC::exp(x); }},
      {"log", [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"sqrt", [](const ex& x) -> ex { return GiNaC::sqrt(x); }},
      {"abs", [](const ex& x) -> ex { return GiNaC::abs(x); }},
      {"sinh", [](const ex& x) -> ex { return GiNaC::sinh(x); }},
      {"cosh", [](const ex& x) -> ex { return GiNaC::cosh(x); }},
      {"tanh", [](const ex& x) -> ex { return GiNaC::tanh(x); }}};
  return functions.at(name)(a);
}

ex operated(char operation, const ex& a, const ex& b) {
  switch (operation) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    default:
      refuse_huge(a, b);
      return GiNaC::pow(a, b);
  }
}

/// Evaluates the postfix order with a stack.
ex computed(const std::vector<ExpressionToken>& postfix, const std::map<std::string, ex>& names) {
  std::vector<ex> stack;
  const auto pop = [&] {
    ex top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const ExpressionToken& token : postfix) {
    const std::string word(token.text);
    if (token.kind == ExpressionToken::number) {
      stack.push_back(number_of(word));
    } else if (token.kind == ExpressionToken::name) {
      stack.push_back(word == "pi" ? ex(GiNaC::Pi) : names.at(word));
    } else {
      const ex last = pop();
      if (token.kind == ExpressionToken::sign)
        stack.push_back(word == "-" ? -last : last);
      else if (token.kind == ExpressionToken::operation)
        stack.push_back(operated(word[0], pop(), last));
      else
        stack.push_back(word == "atan2" ? GiNaC::atan2(pop(), last) : called(word, last));
    }
  }
  return stack.back();
}

}  // namespace

GiNaC::ex parse_expression(const ExpressionText& text, const std::map<std::string, GiNaC::ex>& names) {
  std::vector<std::string> known;
  known.reserve(names.size());
  for (const auto& entry : names) known.push_back(entry.first);
  try {
    return computed(in_postfix_order(checked_tokens(text.text, known)), names);
  } catch (const ExpressionError& error) {
    throw SystemError(location_in(text, error.offset), error.what());
  } catch (const std::exception&) {
    // Exact arithmetic met 1/0, log(0), atan2(0, 0); the library's message names internal classes
    throw SystemError(text.location, quoted_name(text.text) + " " + no_value);
  }
}

}  // namespace incognita
