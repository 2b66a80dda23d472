// An expression in an order and with signs of its own.
//
// The computer algebra keeps terms in an order that changes from one start of the program to the next, and
// with it the sign of what it takes out of powers. Rounding, and what is printed, must not: sums and products
// are sorted by what they say, and a sum leads with a plus, its sign told apart.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "incognita/analysis/systems/latex_names.hpp"

namespace incognita {

struct CanonicalNode;

struct SignedNode {
  bool negative = false;
  std::shared_ptr<const CanonicalNode> node;
};

struct CanonicalNode {
  enum class Kind {
    number,    ///< `number`, positive or 0
    constant,  ///< pi
    symbol,    ///< `symbol`
    sum,       ///< of `parts`
    product,   ///< of `parts`, none of them negative
    power,     ///< parts[0] to the parts[1]
    function   ///< `name` of `parts`
  };
  Kind kind = Kind::number;
  GiNaC::numeric number;
  GiNaC::ex symbol;
  std::string name;
  std::vector<SignedNode> parts;
  std::string text;  ///< what it says, and what it is sorted by
  int binding = 0;   ///< of the text: how tightly it holds together
};

class Canonicalizer {
 public:
  /// Throws std::domain_error for what is not a real function of its symbols, with what that is.
  SignedNode operator()(const GiNaC::ex& expression);

 private:
  SignedNode make(const GiNaC::ex& expression);
  SignedNode sum(const GiNaC::ex& expression);
  SignedNode product(const GiNaC::ex& expression);
  SignedNode power(const GiNaC::ex& expression);

  std::map<GiNaC::ex, SignedNode, GiNaC::ex_is_less> known_;
};

/// As it would be typed: "v*sin(theta)/(rx^2 + ry^2)".
std::string written(const SignedNode& expression);
std::string written(const GiNaC::ex& expression);

/// As it would be typeset.
std::string in_latex(const GiNaC::ex& expression, const LatexNames& names = {});

}  // namespace incognita
