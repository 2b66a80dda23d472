#include "incognita/analysis/systems/canonical_expression.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace incognita {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using Kind = CanonicalNode::Kind;

std::string text_of(const numeric& n) {
  std::ostringstream text;
  text << n;
  return text.str();
}

[[noreturn]] void refuse(const ex& e, const char* why) {
  std::ostringstream text;
  text << e;
  const std::string all = text.str();
  throw std::domain_error("`" + (all.size() > 60 ? all.substr(0, 57) + "..." : all) + "` " + why);
}

/// Sort order: numbers, then names, then sums and functions.
int rank_of(const CanonicalNode& node) {
  const bool compound = node.kind == Kind::function || node.kind == Kind::sum;
  return node.kind == Kind::number ? 0 : compound ? 2 : 1;
}

bool before(const SignedNode& a, const SignedNode& b) {
  const int rank_a = rank_of(*a.node), rank_b = rank_of(*b.node);
  return std::tie(rank_a, a.node->text, a.negative) < std::tie(rank_b, b.node->text, b.negative);
}

SignedNode finished(CanonicalNode node, bool negative);

SignedNode number_node(const numeric& n) {
  CanonicalNode node;
  node.number = abs(n);
  return finished(std::move(node), n.is_negative());
}

}  // namespace

SignedNode Canonicalizer::operator()(const ex& expression) {
  const auto found = known_.find(expression);
  if (found != known_.end()) return found->second;
  SignedNode made = make(expression);
  known_.emplace(expression, made);
  return made;
}

SignedNode Canonicalizer::make(const ex& e) {
  CanonicalNode node;
  if (GiNaC::is_a<numeric>(e)) {
    const numeric n = GiNaC::ex_to<numeric>(e);
    if (!n.is_real()) refuse(e, "is not a real number");
    return number_node(n);
  }
  if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e);
  if (GiNaC::is_a<GiNaC::constant>(e)) {
    node.kind = Kind::constant;
    if (!e.is_equal(GiNaC::Pi)) refuse(e, "cannot be evaluated");
    return finished(std::move(node), false);
  }
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    node.kind = Kind::symbol;
    node.symbol = e;
    node.name = GiNaC::ex_to<GiNaC::symbol>(e).get_name();
    return finished(std::move(node), false);
  }
  if (!GiNaC::is_a<GiNaC::function>(e)) refuse(e, "cannot be evaluated");
  node.kind = Kind::function;
  node.name = GiNaC::ex_to<GiNaC::function>(e).get_name();
  for (std::size_t i = 0; i < e.nops(); ++i) node.parts.push_back((*this)(e.op(i)));
  return finished(std::move(node), false);
}

SignedNode Canonicalizer::sum(const ex& e) {
  CanonicalNode node;
  node.kind = Kind::sum;
  for (std::size_t i = 0; i < e.nops(); ++i) node.parts.push_back((*this)(e.op(i)));
  std::sort(node.parts.begin(), node.parts.end(), before);
  const bool negative = node.parts.front().negative;
  for (SignedNode& part : node.parts) part.negative = part.negative != negative;
  return finished(std::move(node), negative);
}

SignedNode Canonicalizer::product(const ex& e) {
  CanonicalNode node;
  node.kind = Kind::product;
  bool negative = false;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    SignedNode part = (*this)(e.op(i));
    negative = negative != part.negative;
    part.negative = false;
    const bool one = part.node->kind == Kind::number && part.node->number.is_equal(1);
    if (!one) node.parts.push_back(std::move(part));
  }
  if (node.parts.empty()) return {negative, number_node(1).node};
  if (node.parts.size() == 1) return {negative, node.parts.front().node};
  std::sort(node.parts.begin(), node.parts.end(), before);
  return finished(std::move(node), negative);
}

SignedNode Canonicalizer::power(const ex& e) {
  CanonicalNode node;
  node.kind = Kind::power;
  SignedNode base = (*this)(e.op(0));
  const bool whole = e.op(1).info(GiNaC::info_flags::integer);
  const bool negative = base.negative && whole && e.op(1).info(GiNaC::info_flags::odd);
  if (whole) base.negative = false;
  node.parts = {base, (*this)(e.op(1))};
  return finished(std::move(node), negative);
}

namespace {

/// Operator precedence of a text, which decides about parentheses.
enum Binding { of_sum, of_product, of_power, of_atom };

struct Text {
  std::string text;
  Binding binding;
};

std::string inside(const Text& text, Binding least, bool latex) {
  if (text.binding >= least) return text.text;
  return latex ? "\\left(" + text.text + "\\right)" : "(" + text.text + ")";
}

class Writer {
 public:
  Writer() = default;
  /// Writes LaTeX with these names, which must outlive the writer.
  explicit Writer(const LatexNames& names) : latex_(true), names_(&names) {}

  Text write(const SignedNode& e) const {
    if (e.node->kind == Kind::sum) return write_sum(*e.node, e.negative);
    Text text = write(*e.node);
    if (!e.negative) return text;
    return {"-" + inside(text, of_product, latex_), of_sum};
  }

 private:
  Text write(const CanonicalNode& node) const {
    // Cached text: avoids exponential rewriting of nested powers
    if (!latex_ && !node.text.empty()) return {node.text, static_cast<Binding>(node.binding)};
    switch (node.kind) {
      case Kind::number:
        return number(node.number);
      case Kind::constant:
        return {latex_ ? "\\pi" : "pi", of_atom};
      case Kind::symbol:
        return symbol(node);
      case Kind::sum:
        return write_sum(node, false);
      case Kind::product:
        return quotient(node.parts);
      case Kind::power:
        return power(node);
      case Kind::function:
        return function(node);
    }
    return {};
  }

  Text number(const numeric& n) const {
    if (n.is_integer() || !n.is_rational()) return {text_of(n), of_atom};
    if (latex_) return {"\\frac{" + text_of(n.numer()) + "}{" + text_of(n.denom()) + "}", of_atom};
    return {text_of(n.numer()) + "/" + text_of(n.denom()), of_product};
  }

  Text symbol(const CanonicalNode& node) const {
    if (!latex_) return {node.name, of_atom};
    // The name of a derivative has several symbols and needs parentheses in products
    const bool derivative = node.name.find(' ') != std::string::npos;
    return {(*names_)(node.name), derivative ? of_product : of_atom};
  }

  /// Positive terms first, so that few texts begin with a minus.
  Text write_sum(const CanonicalNode& node, bool flipped) const {
    std::string text;
    for (const bool negative : {false, true})
      for (const SignedNode& part : node.parts) {
        if ((part.negative != flipped) != negative) continue;
        const std::string term = inside(write({false, part.node}), of_product, latex_);
        text += (text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ")) + term;
      }
    return {text, of_sum};
  }

  static bool divides(const SignedNode& factor) {
    return factor.node->kind == Kind::power && factor.node->parts[1].negative &&
           factor.node->parts[1].node->kind == Kind::number;
  }

  /// The factor with the sign of its exponent flipped.
  Text inverted(const CanonicalNode& power_node) const {
    CanonicalNode node = power_node;
    node.parts[1].negative = false;
    node.text.clear();
    return power(node);
  }

  Text quotient(const std::vector<SignedNode>& factors) const {
    std::vector<Text> above, below;
    numeric coefficient = 1;
    for (const SignedNode& f : factors) {
      if (f.node->kind == Kind::number)
        coefficient = coefficient * f.node->number;
      else if (divides(f))
        below.push_back(inverted(*f.node));
      else
        above.push_back(write(f));
    }
    if (!coefficient.numer().is_equal(1)) above.insert(above.begin(), number(coefficient.numer()));
    if (!coefficient.denom().is_equal(1)) below.insert(below.begin(), number(coefficient.denom()));
    if (above.empty()) above.push_back({"1", of_atom});
    if (below.empty()) return times(above);
    if (latex_) return {"\\frac{" + times(above).text + "}{" + times(below).text + "}", of_atom};
    const std::string under =
        below.size() == 1 ? inside(below[0], of_power, false) : "(" + times(below).text + ")";
    return {inside(times(above), of_product, false) + "/" + under, of_product};
  }

  Text times(const std::vector<Text>& factors) const {
    if (factors.size() == 1) return factors[0];
    std::string text;
    for (const Text& f : factors)
      text += (text.empty() ? "" : latex_ ? " " : "*") + inside(f, of_power, latex_);
    return {text, of_product};
  }

  Text power(const CanonicalNode& node) const {
    const SignedNode& exponent = node.parts[1];
    const bool is_number = exponent.node->kind == Kind::number;
    if (is_number && exponent.negative) return quotient({{false, std::make_shared<CanonicalNode>(node)}});
    const Text base = write(node.parts[0]);
    if (is_number && exponent.node->number.is_equal(1)) return base;
    if (is_number && exponent.node->number.is_equal(numeric(1, 2)))
      return {latex_ ? "\\sqrt{" + base.text + "}" : "sqrt(" + base.text + ")", of_atom};
    const Text raised = write(exponent);
    if (latex_) return {inside(base, of_atom, true) + "^{" + raised.text + "}", of_power};
    return {inside(base, of_atom, false) + "^" + inside(raised, of_atom, false), of_power};
  }

  Text function(const CanonicalNode& node) const {
    std::string arguments;
    for (const SignedNode& part : node.parts) arguments += (arguments.empty() ? "" : ", ") + write(part).text;
    if (!latex_) return {node.name + "(" + arguments + ")", of_atom};
    if (node.name == "abs") return {"\\left|" + arguments + "\\right|", of_atom};
    const std::string name = node.name == "atan2" ? "\\operatorname{atan2}"
                             : node.name == "asin" || node.name == "acos" || node.name == "atan"
                                 ? "\\arc" + node.name.substr(1)
                                 : "\\" + node.name;
    return {name + "\\left(" + arguments + "\\right)", of_atom};
  }

  bool latex_ = false;
  const LatexNames* names_ = nullptr;
};

SignedNode finished(CanonicalNode node, bool negative) {
  const Text text = Writer().write({false, std::make_shared<CanonicalNode>(node)});
  node.text = text.text;
  node.binding = text.binding;
  return {negative, std::make_shared<CanonicalNode>(std::move(node))};
}

}  // namespace

std::string written(const SignedNode& expression) { return Writer().write(expression).text; }

std::string written(const ex& expression) { return written(Canonicalizer()(expression)); }

std::string in_latex(const ex& expression, const LatexNames& names) {
  return Writer(names).write(Canonicalizer()(expression)).text;
}

}  // namespace incognita
