// An expression compiled for many evaluations: operations in a reproducible order, common subexpressions
// computed once.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace incognita {

class Tape {
 public:
  /// `slot_of` maps a symbol to the index of its value in run(). Throws std::domain_error for an expression
  /// that is not a real function of its symbols, and names it.
  Tape(const GiNaC::ex& expression, const std::function<int(const GiNaC::symbol&)>& slot_of);

  /// May return inf or NaN where the expression is undefined. `scratch`: storage reused between runs.
  double run(std::span<const double> slots, std::vector<double>& scratch) const;

  std::size_t size() const { return operations_.size(); }

 private:
  enum class Kind {
    constant,
    slot,
    add,
    subtract,
    negate,
    multiply,
    power,
    integer_power,
    function_1,
    function_2
  };
  struct Operation {
    Kind kind;
    int a = 0, b = 0;  // registers, the slot, or the integer exponent
    double value = 0;
    double (*f1)(double) = nullptr;
    double (*f2)(double, double) = nullptr;
  };
  struct Builder;

  std::vector<Operation> operations_;
};

/// Number of nodes of the expression as a tree, i.e. the cost of a traversal; counts up to `cap`.
std::size_t tree_size(const GiNaC::ex& expression, std::size_t cap);

}  // namespace incognita
