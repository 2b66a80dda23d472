#include "incognita/analysis/systems/expression_guard.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

using Token = ExpressionToken;

constexpr ExpressionFunction functions[] = {{"sin", 1},  {"cos", 1},   {"tan", 1},  {"asin", 1}, {"acos", 1},
                                            {"atan", 1}, {"atan2", 2}, {"exp", 1},  {"log", 1},  {"sqrt", 1},
                                            {"abs", 1},  {"sinh", 1},  {"cosh", 1}, {"tanh", 1}};
constexpr std::string_view constants[] = {"pi", "Pi", "I", "Euler", "Catalan"};

// The functions of the C library depend on the locale
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool in_name(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

const ExpressionFunction* find_function(std::string_view name) {
  const auto* found =
      std::find_if(std::begin(functions), std::end(functions), [&](const auto& f) { return f.name == name; });
  return found == std::end(functions) ? nullptr : found;
}

std::string in_ticks(std::string_view word) {
  constexpr std::size_t most = 60;
  return "`" + std::string(word.substr(0, most)) + (word.size() > most ? "..." : "") + "`";
}

/// Characters that are not printable ASCII are shown by their code point.
std::string character_in_ticks(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  if (byte >= 0x20 && byte < 0x7f) return in_ticks(text.substr(at, 1));
  unsigned code = byte;
  if (byte >= 0xc0) code = byte & (byte >= 0xf0 ? 0x07u : byte >= 0xe0 ? 0x0fu : 0x1fu);
  const std::size_t more = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
  for (const char c : text.substr(at + 1, more)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  char name[16];
  std::snprintf(name, sizeof name, "U+%04X", code);
  return name;
}

/// State machine of the tokenizer: whether an operand or an operator is expected, the open parentheses, and
/// the depth. Not recursive, since input may be crafted to overflow the stack.
class Guard {
 public:
  Guard(std::string_view text, std::span<const std::string> known) : text_(text), known_(known) {}

  std::vector<Token> tokens() {
    if (text_.size() > longest_expression)
      refuse(0, "an expression has at most " + std::to_string(longest_expression) +
                    " characters, this one has " + std::to_string(text_.size()) +
                    "; name its parts under definitions");
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) take_token();
    if (tokens_.empty()) refuse(0, "the expression is empty");
    if (levels_.size() > 1) refuse(levels_.back().open, "this `(` is never closed");
    if (want_operand_)
      refuse(tokens_.back().offset, "an operand is missing after " + in_ticks(tokens_.back().text));
    return std::move(tokens_);
  }

 private:
  /// A pair of parentheses, or the whole expression.
  struct Level {
    int open = 0;                                  ///< offset of its `(`
    const ExpressionFunction* function = nullptr;  ///< function whose arguments they enclose
    int function_offset = 0;
    int commas = 0;
    int chain = 0;  ///< signs and powers applied to the current operand
  };

  [[noreturn]] static void refuse(std::size_t at, const std::string& why) {
    throw ExpressionError(static_cast<int>(at), why);
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  void push(Token::Kind kind, std::size_t length) {
    tokens_.push_back({kind, text_.substr(at_, length), static_cast<int>(at_)});
    at_ += length;
  }

  void take_token() {
    const char c = text_[at_];
    if (is_letter(c)) return take_name();
    if (is_digit(c) || c == '.') return take_number();
    switch (c) {
      case '(':
        need_operation_before("(");
        return take_open(nullptr);
      case ')':
        return take_close();
      case ',':
        return take_comma();
      case '+':
      case '-':
      case '*':
      case '/':
      case '^':
        return take_operation(c);
      case '=':
        refuse(at_, "an expression has no `=`; its name is the key before it");
      case '_':
        refuse(at_, "a name begins with a letter");
      default:
        refuse(at_, character_in_ticks(text_, at_) +
                        " is not allowed in an expression, which has names, numbers and + - * / ^ ( ) ,");
    }
  }

  void need_operation_before(std::string_view word) const {
    if (!want_operand_)
      refuse(at_, "an operation is missing before " + in_ticks(word) + "; write a product with *");
  }

  std::size_t end_of_digits(std::size_t from) const {
    while (from < text_.size() && is_digit(text_[from])) ++from;
    return from;
  }

  void take_number() {
    std::size_t end = end_of_digits(at_);
    if (end < text_.size() && text_[end] == '.') {
      const std::size_t point = end;
      end = end_of_digits(point + 1);
      if (end == point + 1)
        refuse(point, "a digit is missing after this point; write an integer without a point");
    }
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      const std::size_t sign = end + 1;
      const bool has_sign = sign < text_.size() && (text_[sign] == '-' || text_[sign] == '+');
      const std::size_t digits = sign + (has_sign ? 1 : 0);
      const std::size_t after = end_of_digits(digits);
      if (after > digits) {
        need_small_exponent(text_.substr(digits, after - digits));
        end = after;
      }
    }
    need_sensible_number(text_.substr(at_, end - at_));
    push(Token::number, end - at_);
    want_operand_ = false;
  }

  void need_small_exponent(std::string_view digits) const {
    int exponent = 0;
    for (const char digit : digits) exponent = std::min(10 * exponent + (digit - '0'), 10000);
    if (exponent > largest_decimal_exponent)
      refuse(at_, "a number's exponent is at most " + std::to_string(largest_decimal_exponent) +
                      ", positive or negative; choose other units");
  }

  void need_sensible_number(std::string_view number) const {
    need_operation_before(number);
    if (number.size() > longest_number)
      refuse(at_, "a number has at most " + std::to_string(longest_number) + " characters, this one has " +
                      std::to_string(number.size()));
    double value = 0;
    if (std::from_chars(number.data(), number.data() + number.size(), value).ec != std::errc())
      refuse(at_, in_ticks(number) + " is out of the range of numbers; choose other units");
  }

  void take_name() {
    std::size_t end = at_;
    while (end < text_.size() && in_name(text_[end])) ++end;
    const std::string_view word = text_.substr(at_, end - at_);
    need_operation_before(word);
    while (end < text_.size() && is_blank(text_[end])) ++end;
    const bool called = end < text_.size() && text_[end] == '(';
    const bool known = word == "pi" || std::binary_search(known_.begin(), known_.end(), word, std::less<>());
    if (const ExpressionFunction* function = find_function(word)) {
      if (!called) refuse(at_, in_ticks(word) + " is a function; write " + std::string(word) + "(...)");
      push(Token::function, word.size());
      skip_blanks();
      return take_open(function);
    }
    if (known && called) refuse(at_, in_ticks(word) + " is not a function; write a product with *");
    if (!known) refuse_unknown(word, called);
    push(Token::name, word.size());
    want_operand_ = false;
  }

  [[noreturn]] void refuse_unknown(std::string_view word, bool called) const {
    std::vector<std::string> names;
    if (called) {
      for (const ExpressionFunction& function : functions) names.emplace_back(function.name);
    } else {
      names.assign(known_.begin(), known_.end());
      names.emplace_back("pi");
    }
    refuse(at_, std::string(called ? "there is no function " : "there is no ") + in_ticks(word) +
                    (called ? "" : " in the scope of this expression") + "; the nearest is " +
                    in_ticks(nearest_name(word, names)));
  }

  void go_deeper() {
    if (++depth_ > deepest_expression)
      refuse(at_, "parentheses, signs and powers may be nested at most " +
                      std::to_string(deepest_expression) + " deep; name parts of it under definitions");
  }

  void end_chain() {
    depth_ -= levels_.back().chain;
    levels_.back().chain = 0;
  }

  void take_open(const ExpressionFunction* function) {
    go_deeper();
    levels_.push_back({static_cast<int>(at_), function, function ? tokens_.back().offset : 0});
    push(Token::open, 1);
    want_operand_ = true;
  }

  /// Requires an operand before `end`.
  void need_operand_before(std::string_view end) const {
    if (want_operand_)
      refuse(at_, "an operand is missing " + (tokens_.empty() ? "before " + in_ticks(end)
                                                              : "between " + in_ticks(tokens_.back().text) +
                                                                    " and " + in_ticks(end)));
  }

  void take_close() {
    if (levels_.size() == 1) refuse(at_, "there is no `(` for this `)`");
    need_operand_before(")");
    const Level& level = levels_.back();
    const int wanted = level.function ? level.function->arguments : 1;
    if (level.commas + 1 != wanted)
      refuse(level.function_offset, in_ticks(level.function->name) + " takes " + std::to_string(wanted) +
                                        (wanted == 1 ? " argument" : " arguments") + ", and has " +
                                        std::to_string(level.commas + 1));
    end_chain();
    --depth_;
    levels_.pop_back();
    push(Token::close, 1);
  }

  void take_comma() {
    if (!levels_.back().function) refuse(at_, "a comma is allowed only between the arguments of a function");
    need_operand_before(",");
    end_chain();
    ++levels_.back().commas;
    push(Token::comma, 1);
    want_operand_ = true;
  }

  void take_operation(char c) {
    if (c == '*' && text_.substr(at_, 2) == "**") refuse(at_, "write a power with ^, not **");
    if (want_operand_ && (c == '+' || c == '-')) {
      go_deeper();
      ++levels_.back().chain;
      return push(Token::sign, 1);
    }
    need_operand_before(std::string_view(&c, 1));
    if (c == '^') {
      go_deeper();
      ++levels_.back().chain;
    } else {
      end_chain();
    }
    push(Token::operation, 1);
    want_operand_ = true;
  }

  std::string_view text_;
  std::span<const std::string> known_;
  std::size_t at_ = 0;
  bool want_operand_ = true;
  int depth_ = 0;
  std::vector<Level> levels_{Level{}};
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<ExpressionToken> checked_tokens(std::string_view text, std::span<const std::string> known) {
  return Guard(text, known).tokens();
}

std::span<const ExpressionFunction> expression_functions() { return functions; }

bool is_reserved_name(std::string_view name) {
  return find_function(name) ||
         std::find(std::begin(constants), std::end(constants), name) != std::end(constants);
}

}  // namespace incognita
