// Named quantities: atoms, given from outside, or expressions of earlier ones. Derivatives are exact (GiNaC)
// within each expression and propagate by the chain rule, so that neither a Jacobian nor a repeated Lie
// derivative is expanded in full.
#pragma once

#include <ginac/ginac.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/analysis/systems/system_text.hpp"
#include "incognita/analysis/systems/tape.hpp"

namespace incognita {

/// Owner of a quantity. Landmark and anchor exist once here and are evaluated once per instance; their
/// expressions may use the vehicle's quantities but not each other's. Quantities of the motion (inputs and
/// initial states of a kind of motion) are evaluated only at the start of a motion.
enum class Owner { vehicle, landmark, anchor, motion };

class ExpressionGraph {
 public:
  /// Index of a quantity; it depends only on smaller ones.
  using Slot = int;

  struct Quantity {
    std::string name;
    Owner owner = Owner::vehicle;
    SourceLocation location;  ///< in the file
    GiNaC::realsymbol symbol;
    std::optional<GiNaC::ex> expression;  ///< empty: an atom
    std::optional<Tape> tape;
    std::vector<std::pair<Slot, GiNaC::ex>> partials;  ///< one per quantity in the expression
    std::vector<Tape> partial_tapes;
    int column = -1;     ///< in the gradient, for a state
    bool named = false;  ///< expressions may name it: an atom or a definition of the file
  };

  /// Throws SystemError if the graph becomes too large to compute in reasonable time.
  Slot add_atom(const std::string& name, Owner owner, SourceLocation location, int column = -1);
  /// `owner`: the lowest possible owner, raised by the owners of what the expression uses. `named`: later
  /// texts may name it.
  Slot define(const std::string& name, Owner owner, const GiNaC::ex& expression, SourceLocation location,
              bool named = false);
  /// Checks and parses a text; its names must be visible to `sees` (its own and the vehicle's).
  GiNaC::ex parse(const ExpressionText& text, Owner sees) const;

  int size() const { return static_cast<int>(quantities_.size()); }
  const Quantity& operator[](Slot slot) const { return quantities_[static_cast<std::size_t>(slot)]; }
  std::optional<Slot> find(const std::string& name, Owner sees) const;
  Slot slot_of(const GiNaC::symbol& symbol) const;

  /// Derivative with respect to an atom, in terms of named quantities.
  GiNaC::ex derivative(const GiNaC::ex& expression, Slot atom) const;

  /// Whether all second derivatives with respect to the atoms vanish without simplification. Expressions with
  /// abs in a first derivative count as not affine, since their second derivative is 0 wherever it exists.
  bool is_affine_in(const GiNaC::ex& expression, const std::vector<Slot>& atoms) const;

  /// Values of all quantities of one owner and their gradients with respect to the states; for owners other
  /// than the vehicle, the vehicle's must be evaluated already. Throws SystemError if one is not finite.
  struct Evaluation {
    std::vector<double> value;  ///< by slot; atoms are set from outside
    Eigen::MatrixXd gradient;   ///< column of a state x slot
    Eigen::MatrixXd terms;      ///< same shape: sum of magnitudes of the terms; rounding is 1e-16 of it
    std::vector<double> scratch;
  };
  void prepare(Evaluation& evaluation, int columns) const;
  /// `only`: mask by slot of what to evaluate; null: all.
  void evaluate(Owner owner, Evaluation& evaluation, bool with_gradients,
                const std::vector<bool>* only = nullptr) const;

  /// Mask by slot of the given quantities and all their dependencies.
  std::vector<bool> needed_for(const std::vector<Slot>& slots) const;

 private:
  void spend(std::size_t nodes, SourceLocation location);
  std::vector<std::string> zeros_in(Slot slot, const Evaluation& evaluation) const;
  [[noreturn]] void refuse_value(Slot slot, const Evaluation& evaluation, const char* what) const;
  GiNaC::ex derivative(const GiNaC::ex& expression, Slot atom, std::map<Slot, GiNaC::ex>& known) const;

  std::vector<Quantity> quantities_;
  std::map<GiNaC::ex, Slot, GiNaC::ex_is_less> slots_;
  std::size_t spent_ = 0;
};

}  // namespace incognita
