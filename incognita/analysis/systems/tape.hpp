// An expression made ready for many evaluations: its operations in an order that is always the same, parts
// that occur twice computed once.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace incognita {

class Tape {
 public:
  /// `slot_of` a symbol: where its value stands in what the tape is run on. Throws std::domain_error for what
  /// is not a real function of its symbols, with what that is.
  Tape(const GiNaC::ex& expression, const std::function<int(const GiNaC::symbol&)>& slot_of);

  /// May be inf or NaN where the expression is not defined. `scratch`: room to work, reused between runs.
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
    int a = 0, b = 0;  // registers, or the slot, or the whole exponent
    double value = 0;
    double (*f1)(double) = nullptr;
    double (*f2)(double, double) = nullptr;
  };
  struct Builder;

  std::vector<Operation> operations_;
};

/// Nodes of the expression, told as a tree: what a walk over it costs. Counts to `cap` and no further.
std::size_t tree_size(const GiNaC::ex& expression, std::size_t cap);

}  // namespace incognita
