#include "incognita/analysis/systems/tape.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "incognita/analysis/systems/canonical_expression.hpp"

namespace incognita {
namespace {

using Unary = double (*)(double);

double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }
double tangent(double x) { return std::tan(x); }
double arc_sine(double x) { return std::asin(x); }
double arc_cosine(double x) { return std::acos(x); }
double arc_tangent(double x) { return std::atan(x); }
double exponential(double x) { return std::exp(x); }
double logarithm(double x) { return std::log(x); }
double absolute(double x) { return std::abs(x); }
double hyperbolic_sine(double x) { return std::sinh(x); }
double hyperbolic_cosine(double x) { return std::cosh(x); }
double hyperbolic_tangent(double x) { return std::tanh(x); }
double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
double step(double x) { return x > 0 ? 1 : x < 0 ? 0 : 0.5; }
double conjugate(double x) { return x; }
double arc_tangent_2(double y, double x) { return std::atan2(y, x); }

Unary unary(const std::string& name) {
  static const std::map<std::string, Unary> known{{"sin", sine},
                                                  {"cos", cosine},
                                                  {"tan", tangent},
                                                  {"asin", arc_sine},
                                                  {"acos", arc_cosine},
                                                  {"atan", arc_tangent},
                                                  {"exp", exponential},
                                                  {"log", logarithm},
                                                  {"abs", absolute},
                                                  {"sinh", hyperbolic_sine},
                                                  {"cosh", hyperbolic_cosine},
                                                  {"tanh", hyperbolic_tangent},
                                                  {"csgn", sign},
                                                  {"step", step},
                                                  {"conjugate", conjugate},
                                                  {"real_part", conjugate}};
  const auto found = known.find(name);
  return found == known.end() ? nullptr : found->second;
}

double power_of(double base, int exponent) {
  double result = 1;
  for (unsigned left = static_cast<unsigned>(std::abs(exponent)); left > 0; left >>= 1, base *= base)
    if (left & 1u) result *= base;
  return exponent < 0 ? 1 / result : result;
}

}  // namespace

struct Tape::Builder {
  const std::function<int(const GiNaC::symbol&)>& slot_of;
  std::vector<Operation>& operations;
  std::map<std::string, int> known;  // registers by the text of the expression

  int push(Operation operation) {
    operations.push_back(operation);
    return static_cast<int>(operations.size()) - 1;
  }

  int add(const SignedNode& e) {
    const int positive = add(*e.node);
    return e.negative ? push({.kind = Kind::negate, .a = positive}) : positive;
  }

  int add(const CanonicalNode& node) {
    const auto found = known.find(node.text);
    if (found != known.end()) return found->second;
    const int made = make(node);
    known.emplace(node.text, made);
    return made;
  }

  int make(const CanonicalNode& node) {
    switch (node.kind) {
      case CanonicalNode::Kind::number:
        return push({.kind = Kind::constant, .value = node.number.to_double()});
      case CanonicalNode::Kind::constant:
        return push({.kind = Kind::constant, .value = std::numbers::pi});
      case CanonicalNode::Kind::symbol:
        return push({.kind = Kind::slot, .a = slot_of(GiNaC::ex_to<GiNaC::symbol>(node.symbol))});
      case CanonicalNode::Kind::sum:
        return sum(node);
      case CanonicalNode::Kind::product:
        return product(node);
      case CanonicalNode::Kind::power:
        return power(node);
      case CanonicalNode::Kind::function:
        return function(node);
    }
    return -1;
  }

  int sum(const CanonicalNode& node) {
    int all = add(node.parts[0]);  // never negative
    for (std::size_t i = 1; i < node.parts.size(); ++i) {
      const int next = add(*node.parts[i].node);
      all = push({.kind = node.parts[i].negative ? Kind::subtract : Kind::add, .a = all, .b = next});
    }
    return all;
  }

  int product(const CanonicalNode& node) {
    int all = add(node.parts[0]);
    for (std::size_t i = 1; i < node.parts.size(); ++i) {
      const int next = add(node.parts[i]);
      all = push({.kind = Kind::multiply, .a = all, .b = next});
    }
    return all;
  }

  int power(const CanonicalNode& node) {
    const int base = add(node.parts[0]);
    const SignedNode& exponent = node.parts[1];
    if (exponent.node->kind == CanonicalNode::Kind::number) {
      const GiNaC::numeric& by = exponent.node->number;
      if (by.is_integer() && by <= 64)
        return push(
            {.kind = Kind::integer_power, .a = base, .b = exponent.negative ? -by.to_int() : by.to_int()});
      if (by.is_equal(GiNaC::numeric(1, 2))) {
        const int root =
            push({.kind = Kind::function_1, .a = base, .f1 = [](double x) { return std::sqrt(x); }});
        return exponent.negative ? push({.kind = Kind::integer_power, .a = root, .b = -1}) : root;
      }
    }
    const int by = add(exponent);
    return push({.kind = Kind::power, .a = base, .b = by});
  }

  int function(const CanonicalNode& node) {
    if (node.name == "atan2") {
      const int y = add(node.parts[0]), x = add(node.parts[1]);
      return push({.kind = Kind::function_2, .a = y, .b = x, .f2 = arc_tangent_2});
    }
    const Unary f = node.parts.size() == 1 ? unary(node.name) : nullptr;
    if (!f) throw std::domain_error("`" + node.text.substr(0, 60) + "` cannot be evaluated");
    const int x = add(node.parts[0]);
    return push({.kind = Kind::function_1, .a = x, .f1 = f});
  }
};

Tape::Tape(const GiNaC::ex& expression, const std::function<int(const GiNaC::symbol&)>& slot_of) {
  Builder builder{slot_of, operations_, {}};
  builder.add(Canonicalizer()(expression));
}

double Tape::run(std::span<const double> slots, std::vector<double>& r) const {
  r.resize(std::max(r.size(), operations_.size()));
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    const Operation& o = operations_[i];
    switch (o.kind) {
      case Kind::constant:
        r[i] = o.value;
        break;
      case Kind::slot:
        r[i] = slots[o.a];
        break;
      case Kind::add:
        r[i] = r[o.a] + r[o.b];
        break;
      case Kind::subtract:
        r[i] = r[o.a] - r[o.b];
        break;
      case Kind::negate:
        r[i] = -r[o.a];
        break;
      case Kind::multiply:
        r[i] = r[o.a] * r[o.b];
        break;
      case Kind::power:
        r[i] = std::pow(r[o.a], r[o.b]);
        break;
      case Kind::integer_power:
        r[i] = power_of(r[o.a], o.b);
        break;
      case Kind::function_1:
        r[i] = o.f1(r[o.a]);
        break;
      case Kind::function_2:
        r[i] = o.f2(r[o.a], r[o.b]);
        break;
    }
  }
  return r[operations_.size() - 1];
}

std::size_t tree_size(const GiNaC::ex& e, std::size_t cap) {
  std::size_t size = 1;
  for (std::size_t i = 0; i < e.nops() && size <= cap; ++i) size += tree_size(e.op(i), cap - size);
  return size;
}

}  // namespace incognita
