// The tokenizer and parser of expressions: accepted input, every kind of error, and the order of evaluation.
#include "incognita/analysis/systems/expression_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "incognita/analysis/systems/expression_postfix.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

const std::vector<std::string> known = {"a", "b", "c", "e", "omega", "theta", "v", "x", "y"};

/// The tokens, each preceded by the letter of its kind.
std::string taken_apart(const std::string& text) {
  static constexpr char letters[] = {'n', 'N', 'f', 's', 'o', '(', ')', ','};
  std::string all;
  for (const ExpressionToken& token : checked_tokens(text, known)) {
    EXPECT_EQ(text.substr(static_cast<std::size_t>(token.offset), token.text.size()), token.text);
    all += (all.empty() ? "" : " ") + std::string(1, letters[token.kind]) + ":" + std::string(token.text);
  }
  return all;
}

/// "offset: error message", or "fine".
std::string problem(const std::string& text) {
  try {
    checked_tokens(text, known);
    return "fine";
  } catch (const ExpressionError& error) {
    EXPECT_GE(error.offset, 0);
    EXPECT_LE(error.offset, static_cast<int>(text.size()));
    return std::to_string(error.offset) + ": " + error.what();
  }
}

std::string repeated(const std::string& part, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += part;
  return all;
}

TEST(ExpressionGuard, SplitsIntoTokens) {
  EXPECT_EQ(taken_apart("v*cos(theta)"), "N:v o:* f:cos (:( N:theta ):)");
  EXPECT_EQ(taken_apart(" atan2 (y, -x)-\ttheta "), "f:atan2 (:( N:y ,:, s:- N:x ):) o:- N:theta");
  EXPECT_EQ(taken_apart("-a^-2"), "s:- N:a o:^ s:- n:2");
  EXPECT_EQ(taken_apart("2*e - 2*pi"), "n:2 o:* N:e o:- n:2 o:* N:pi");
  EXPECT_EQ(taken_apart("1e-3+1.5E+2*.5"), "n:1e-3 o:+ n:1.5E+2 o:* n:.5");
  EXPECT_EQ(taken_apart("(((x)))\n+ 1"), "(:( (:( (:( N:x ):) ):) ):) o:+ n:1");
}

TEST(ExpressionGuard, AcceptsEveryFunction) {
  for (const ExpressionFunction& function : expression_functions()) {
    const std::string name(function.name);
    const std::string right = function.arguments == 1 ? "(x)" : "(x, y)";
    EXPECT_EQ(problem(name + right), "fine");
    EXPECT_EQ(problem("1 + " + name), "4: `" + name + "` is a function; write " + name + "(...)");
    EXPECT_TRUE(problem("1 + " + name + "(x, y, x)").starts_with("4: `" + name + "` takes ")) << name;
    EXPECT_TRUE(is_reserved_name(name));
  }
  EXPECT_EQ(expression_functions().size(), 14u);
  for (const char* constant : {"pi", "Pi", "I", "Euler", "Catalan"}) EXPECT_TRUE(is_reserved_name(constant));
  EXPECT_FALSE(is_reserved_name("x"));
}

TEST(ExpressionGuard, ErrorsNameOffsetAndRemedy) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "0: the expression is empty"},
      {" \t\n", "0: the expression is empty"},
      {"a**2", "1: write a power with ^, not **"},
      {"a = 2", "2: an expression has no `=`; its name is the key before it"},
      {"a % 2", "2: `%` is not allowed in an expression, which has names, numbers and + - * / ^ ( ) ,"},
      {"a; b", "1: `;` is not allowed"},
      {"a[1]", "1: `[` is not allowed"},
      {"\"a\"", "0: `\"` is not allowed"},
      {"a * \xce\xb8", "4: U+03B8 is not allowed"},
      {"a \xe2\x88\x92 b", "2: U+2212 is not allowed"},
      {"a\xff", "1: U+"},
      {"\xe2", "0: U+0002 is not allowed"},
      {"a_1", "0: there is no `a_1` in the scope of this expression; the nearest is `a`"},
      {"_a", "0: a name begins with a letter"},
      {"v*thetta", "2: there is no `thetta` in the scope of this expression; the nearest is `theta`"},
      {"Pi", "0: there is no `Pi` in the scope of this expression; the nearest is `pi`"},
      {"1 + sine(x)", "4: there is no function `sine`; the nearest is `sin`"},
      {"2*x (y)", "2: `x` is not a function; write a product with *"},
      {"pi(2)", "0: `pi` is not a function; write a product with *"},
      {"cos", "0: `cos` is a function; write cos(...)"},
      {"sin(x, y)", "0: `sin` takes 1 argument, and has 2"},
      {"1+atan2(x)", "2: `atan2` takes 2 arguments, and has 1"},
      {"sin()", "4: an operand is missing between `(` and `)`"},
      {"()", "1: an operand is missing between `(` and `)`"},
      {"atan2(x,)", "8: an operand is missing between `,` and `)`"},
      {"atan2(,x)", "6: an operand is missing between `(` and `,`"},
      {"(x, y)", "2: a comma is allowed only between the arguments of a function"},
      {"x, y", "1: a comma is allowed only between the arguments of a function"},
      {"atan2((x, y), y)", "8: a comma is allowed only between the arguments of a function"},
      {"a*(b + c", "2: this `(` is never closed"},
      {"sin(", "3: this `(` is never closed"},
      {"(a))", "3: there is no `(` for this `)`"},
      {")", "0: there is no `(` for this `)`"},
      {"a +", "2: an operand is missing after `+`"},
      {"-", "0: an operand is missing after `-`"},
      {"*a", "0: an operand is missing before `*`"},
      {"a + * b", "4: an operand is missing between `+` and `*`"},
      {"a - / b", "4: an operand is missing between `-` and `/`"},
      {"(a + )", "5: an operand is missing between `+` and `)`"},
      {"a b", "2: an operation is missing before `b`; write a product with *"},
      {"2x", "1: an operation is missing before `x`"},
      {"2e", "1: an operation is missing before `e`"},
      {"a 2", "2: an operation is missing before `2`"},
      {"(a)(b)", "3: an operation is missing before `(`"},
      {"(a) sin(b)", "4: an operation is missing before `sin`"},
      {"1.5.5", "3: an operation is missing before `.5`"},
      {"1.", "1: a digit is missing after this point; write an integer without a point"},
      {".", "0: a digit is missing after this point"},
      {"1.e5", "1: a digit is missing after this point"},
      {"1e301", "0: a number's exponent is at most 300, positive or negative; choose other units"},
      {"a+1e-301", "2: a number's exponent is at most 300"},
      {"1e99999999999999999999", "0: a number's exponent is at most 300"},
      {"99999999999e300", "0: `99999999999e300` is out of the range of numbers; choose other units"},
      {"0.00000000000000000000000000001e-300",
       "0: `0.00000000000000000000000000001e-300` is out of the range"}};
  for (const auto& [text, wanted] : cases)
    EXPECT_TRUE(problem(text).starts_with(wanted)) << "`" << text << "` gives `" << problem(text) << "`";
}

TEST(ExpressionGuard, NulIsAnOrdinaryInvalidCharacter) {
  EXPECT_TRUE(problem(std::string("a\0b", 3)).starts_with("1: U+0000 is not allowed"));
}

TEST(ExpressionGuard, LimitsLengthAndDepth) {
  EXPECT_EQ(problem(std::string(40, '1')), "fine");
  EXPECT_EQ(problem(std::string(41, '1')), "0: a number has at most 40 characters, this one has 41");
  EXPECT_EQ(problem("1e300"), "fine");
  EXPECT_EQ(problem("x" + std::string(4095, ' ')), "fine");
  EXPECT_TRUE(
      problem("x" + std::string(4096, ' ')).starts_with("0: an expression has at most 4096 characters"));
  EXPECT_TRUE(problem(std::string(4000, 'x')).starts_with("0: there is no `xxx"));
}

TEST(ExpressionGuard, DepthCountsParenthesesSignsAndPowers) {
  const auto nested = [](int n) { return repeated("(", n) + "x" + repeated(")", n); };
  EXPECT_EQ(problem(nested(100)), "fine");
  EXPECT_TRUE(problem(nested(101)).starts_with("100: parentheses, signs and powers may be nested"));
  EXPECT_EQ(problem(repeated("-", 100) + "x"), "fine");
  EXPECT_TRUE(problem(repeated("-+", 51) + "x").starts_with("100: parentheses"));
  EXPECT_EQ(problem(repeated("x^", 100) + "x"), "fine");
  EXPECT_TRUE(problem(repeated("x^", 101) + "x").starts_with("201: parentheses"));
  EXPECT_TRUE(problem(repeated("x^-", 51) + "x").starts_with("151: parentheses"));
  EXPECT_TRUE(problem(repeated("-(", 51) + "x").starts_with("100: parentheses"));
  EXPECT_TRUE(problem(repeated("sin(", 101)).starts_with("403: parentheses"));
  // Operands side by side do not add depth
  EXPECT_EQ(problem(repeated("-x^2*", 500) + "x"), "fine");
  EXPECT_EQ(problem(repeated("(x)-", 1000) + "x"), "fine");
  EXPECT_EQ(problem(repeated("atan2(-x^2, -y^2) + ", 200) + "x"), "fine");
}

double apply(const ExpressionToken& token, std::vector<double>& stack) {
  const auto pop = [&] {
    const double top = stack.back();
    stack.pop_back();
    return top;
  };
  const double b = pop();
  if (token.kind == ExpressionToken::sign) return token.text == "-" ? -b : b;
  if (token.text == "sin") return std::sin(b);
  if (token.text == "asin") return std::asin(b);
  const double a = pop();
  if (token.text == "atan2") return std::atan2(a, b);
  if (token.text == "^") return std::pow(a, b);
  if (token.text == "*") return a * b;
  if (token.text == "/") return a / b;
  return token.text == "+" ? a + b : a - b;
}

double computed(const std::string& text) {
  static const std::map<std::string, double> values = {
      {"a", 3}, {"b", 2}, {"c", 0.5}, {"x", 1.25}, {"y", -0.75}};
  const std::vector<ExpressionToken> tokens = checked_tokens(text, known);
  std::vector<double> stack;
  for (const ExpressionToken& token : in_postfix_order(tokens)) {
    const std::string word(token.text);
    const double value = token.kind == ExpressionToken::number ? std::stod(word)
                         : token.kind == ExpressionToken::name ? values.at(word)
                                                               : apply(token, stack);
    stack.push_back(value);
  }
  EXPECT_EQ(stack.size(), 1u) << text;
  return stack.back();
}

TEST(ExpressionPostfix, FollowsPrecedence) {
  const double a = 3, b = 2, c = 0.5, x = 1.25, y = -0.75;
  EXPECT_EQ(computed("a - b - c"), a - b - c);
  EXPECT_EQ(computed("a / b / c * x"), a / b / c * x);
  EXPECT_EQ(computed("a - b * c + x"), a - b * c + x);
  EXPECT_EQ(computed("-a^2"), -9);
  EXPECT_EQ(computed("(-a)^2"), 9);
  EXPECT_EQ(computed("a^-b"), 1.0 / 9);
  EXPECT_EQ(computed("b^-b^b"), 1.0 / 16);
  EXPECT_EQ(computed("a^b^c"), std::pow(a, std::pow(b, c)));
  EXPECT_EQ(computed("a*-b - c"), a * -b - c);
  EXPECT_EQ(computed("a - x*-a^b - b"), a - x * -9 - b);
  EXPECT_EQ(computed("a--b"), 5);
  EXPECT_EQ(computed("--a-+-b"), 5);
  EXPECT_EQ(computed("b^-a*c"), 0.125 * c);
  EXPECT_EQ(computed("-(a + b)^2*c"), -12.5);
  EXPECT_EQ(computed("2*atan2(a - b*c, -x + sin(y)*a)^2 - 1"),
            2 * std::pow(std::atan2(a - b * c, -x + std::sin(y) * a), 2) - 1);
  EXPECT_EQ(computed("sin(sin(a)*b)/c"), std::sin(std::sin(a) * b) / c);
}

/// Random token sequences: either refused or a postfix sequence that a stack can evaluate.
TEST(ExpressionGuard, RandomTokensAreRefusedOrEvaluable) {
  static constexpr const char* words[] = {"a", "x", "2", ".5", "1e3", "sin(", "atan2(", "(",   ")", ")",
                                          ",", "+", "-", "*",  "/",   "^",    " ",      "sin", "b", "**"};
  RandomStream random(7, "words");
  int fine = 0;
  for (int i = 0; i < 50'000; ++i) {
    std::string text;
    for (int n = 1 + random.below(9); n > 0; --n) text += words[random.below(std::size(words))];
    if (problem(text) == "fine") {
      computed(text);
      ++fine;
    }
  }
  EXPECT_GT(fine, 1000);
}

}  // namespace
}  // namespace incognita
