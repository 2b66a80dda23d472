// Named quantities, each given from outside (an atom) or an expression of earlier ones. Derivatives are exact
// (GiNaC) within each expression, and the chain rule carries them from one to the next, so that neither a
// Jacobian nor a repeated Lie derivative is ever written out in full.
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

/// Whose a quantity is. Of landmark and anchor there is one here, evaluated once for each that is there; they
/// see the vehicle's quantities and not each other's. What a kind of motion makes of inputs and initial
/// states is evaluated only where a motion begins.
enum class Owner { vehicle, landmark, anchor, motion };

class ExpressionGraph {
 public:
  /// A quantity's number. What it depends on has smaller ones.
  using Slot = int;

  struct Quantity {
    std::string name;
    Owner owner = Owner::vehicle;
    SourceLocation location;  ///< of what it comes from in the file
    GiNaC::realsymbol symbol;
    std::optional<GiNaC::ex> expression;  ///< none: an atom
    std::optional<Tape> tape;
    std::vector<std::pair<Slot, GiNaC::ex>> partials;  ///< to each quantity it names
    std::vector<Tape> partial_tapes;
    int column = -1;     ///< of the gradient, for a state
    bool named = false;  ///< expressions may name it: an atom or a definition of the file's
  };

  /// Throws SystemError when the graph grows past what can be computed in reasonable time.
  Slot add_atom(const std::string& name, Owner owner, SourceLocation location, int column = -1);
  /// `owner`: at least; what it names may make it another's. `named`: later texts may name it.
  Slot define(const std::string& name, Owner owner, const GiNaC::ex& expression, SourceLocation location,
              bool named = false);
  /// Checks, parses, and takes a text that names quantities that `sees` (itself and the vehicle's).
  GiNaC::ex parse(const ExpressionText& text, Owner sees) const;

  int size() const { return static_cast<int>(quantities_.size()); }
  const Quantity& operator[](Slot slot) const { return quantities_[static_cast<std::size_t>(slot)]; }
  std::optional<Slot> find(const std::string& name, Owner sees) const;
  Slot slot_of(const GiNaC::symbol& symbol) const;

  /// Derivative to an atom, written out in terms of named quantities.
  GiNaC::ex derivative(const GiNaC::ex& expression, Slot atom) const;

  /// Whether every second derivative to the atoms is 0 on sight. What has abs in a first derivative counts as
  /// not affine: its second derivative is 0 wherever it has one.
  bool is_affine_in(const GiNaC::ex& expression, const std::vector<Slot>& atoms) const;

  /// Values, and gradients to the states, of every quantity of one owner; those of the vehicle must stand
  /// there already when it is another's. Throws SystemError where one is not finite.
  struct Evaluation {
    std::vector<double> value;  ///< by slot; atoms are set from outside
    Eigen::MatrixXd gradient;   ///< column of a state x slot
    Eigen::MatrixXd terms;      ///< likewise: size of what was added up to each; its rounding is 1e-16 of it
    std::vector<double> scratch;
  };
  void prepare(Evaluation& evaluation, int columns) const;
  /// `only`: by slot, which to evaluate; all where there is none.
  void evaluate(Owner owner, Evaluation& evaluation, bool with_gradients,
                const std::vector<bool>* only = nullptr) const;

  /// Those that the given ones are made of, and they themselves, by slot.
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
