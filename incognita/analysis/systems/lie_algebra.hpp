// Vector fields of a system, and symbolic derivatives along them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {

/// Vector field: rates of the states of the vehicle and of a landmark.
struct VectorField {
  std::string name;
  std::map<ExpressionGraph::Slot, GiNaC::ex> rates;  ///< nonzero ones
};

class LieAlgebra {
 public:
  using Slot = ExpressionGraph::Slot;

  /// `other_inputs`: number of further sets of held inputs.
  LieAlgebra(const SymbolicSystem& system, int other_inputs);

  const SymbolicSystem& system() const { return system_; }
  const std::vector<VectorField>& fields() const { return fields_; }
  bool inputs_nonlinear() const { return nonlinear_; }
  /// Measurements with the inputs of the further sets substituted, if measurements depend on inputs.
  struct OtherMeasurement {
    Slot original = 0;
    Slot slot = 0;
  };
  const std::vector<OtherMeasurement>& other_measurements() const { return other_measurements_; }
  /// Copies of the inputs for the further sets, by set, then input; empty if none are held.
  const std::vector<std::vector<Slot>>& input_copies() const { return copies_; }

  /// L_field of a quantity, (4.62): the slot of the derivative, or -1 if it vanishes.
  Slot derive(Slot quantity, int field, SourceLocation location);

 private:
  GiNaC::ex derived(Slot quantity, int field, SourceLocation location);
  bool is_linear_in(const std::vector<Slot>& inputs) const;
  bool moves_with(const std::vector<Slot>& inputs) const;
  GiNaC::exmap replaced(GiNaC::exmap inputs, const std::string& tag);
  GiNaC::exmap replaced(GiNaC::exmap inputs, const std::string& tag, const std::vector<Slot>& wanted);
  GiNaC::ex quantity_like(Slot original, const GiNaC::ex& expression, const std::string& tag);
  void substitute(const std::vector<SymbolicSystem::Assignment>& tied);
  Slot substituted(Slot original, const GiNaC::exmap& with);
  VectorField field(const std::string& name, const GiNaC::exmap& with) const;
  bool measures(const std::vector<Slot>& inputs) const;
  void add_fields(int other_inputs);
  void add_input_fields(const std::vector<Slot>& inputs, const GiNaC::exmap& others_zero);
  void add_further_sets(int count, const std::vector<Slot>& held, const GiNaC::exmap& zero, bool as_fields);
  std::vector<Slot> measurements() const;

  SymbolicSystem system_;
  std::vector<VectorField> fields_;
  std::vector<std::vector<Slot>> copies_;
  std::vector<OtherMeasurement> other_measurements_;
  std::map<std::pair<Slot, int>, GiNaC::ex> known_;
  bool nonlinear_ = false;
};

}  // namespace incognita
