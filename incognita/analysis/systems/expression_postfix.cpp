#include "incognita/analysis/systems/expression_postfix.hpp"

namespace incognita {
namespace {

using Token = ExpressionToken;

int rank(const Token& token) {
  if (token.kind == Token::sign) return 3;
  if (token.text == "^") return 4;
  return token.text == "*" || token.text == "/" ? 2 : 1;
}

/// Dijkstra's shunting-yard algorithm.
class Yard {
 public:
  void take(const Token& token) {
    switch (token.kind) {
      case Token::number:
      case Token::name:
        done_.push_back(token);
        break;
      case Token::function:
      case Token::sign:
      case Token::open:
        waiting_.push_back(token);
        break;
      case Token::operation:
        finish_operations(token.text == "^" ? rank(token) + 1 : rank(token));
        waiting_.push_back(token);
        break;
      case Token::comma:
        finish_operations(0);
        break;
      case Token::close:
        finish_operations(0);
        waiting_.pop_back();  // the `(`
        if (!waiting_.empty() && waiting_.back().kind == Token::function) finish_one();
    }
  }

  std::vector<Token> done() {
    finish_operations(0);
    return std::move(done_);
  }

 private:
  void finish_one() {
    done_.push_back(waiting_.back());
    waiting_.pop_back();
  }

  /// Outputs operators of at least that rank, back to the last `(`.
  void finish_operations(int least) {
    while (!waiting_.empty() && waiting_.back().kind != Token::open && rank(waiting_.back()) >= least)
      finish_one();
  }

  std::vector<Token> waiting_, done_;
};

}  // namespace

std::vector<ExpressionToken> in_postfix_order(std::span<const ExpressionToken> checked) {
  Yard yard;
  for (const Token& token : checked) yard.take(token);
  return yard.done();
}

}  // namespace incognita
