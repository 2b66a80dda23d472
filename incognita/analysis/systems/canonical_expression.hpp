// Canonical form of an expression: a fixed order and fixed signs.
//
// The computer algebra orders terms differently in every run of the program, and with the order changes the
// sign factored out of powers. Rounding and printed text must be reproducible: sums and products are sorted
// by their text, and a sum leads with a positive term, its sign kept separately.
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
  std::string text;  ///< as written; the sort key
  int binding = 0;   ///< operator precedence of the text
};

class Canonicalizer {
 public:
  /// Throws std::domain_error for an expression that is not a real function of its symbols, and names it.
  SignedNode operator()(const GiNaC::ex& expression);

 private:
  SignedNode make(const GiNaC::ex& expression);
  SignedNode sum(const GiNaC::ex& expression);
  SignedNode product(const GiNaC::ex& expression);
  SignedNode power(const GiNaC::ex& expression);

  std::map<GiNaC::ex, SignedNode, GiNaC::ex_is_less> known_;
};

/// As plain text: "v*sin(theta)/(rx^2 + ry^2)".
std::string written(const SignedNode& expression);
std::string written(const GiNaC::ex& expression);

/// As LaTeX.
std::string in_latex(const GiNaC::ex& expression, const LatexNames& names = {});

}  // namespace incognita
