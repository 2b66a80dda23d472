// A system with given numbers of landmarks and anchors, in numbers.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/analysis/systems/linearization.hpp"
#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {

struct NamedDirection {
  std::string name;
  Eigen::VectorXd vector;    ///< n
  bool of_landmark = false;  ///< changes only one landmark
};

class SystemInstance {
 public:
  /// Throws std::invalid_argument for landmarks or anchors of a system without them, for negative numbers,
  /// and if nothing is measured. Keeps a reference to the system.
  SystemInstance(const SymbolicSystem& system, int landmarks, int anchors);

  int states() const { return states_; }
  int measurements() const { return measurements_; }
  int landmarks() const { return landmarks_; }
  int anchors() const { return anchors_; }
  const SymbolicSystem& system() const { return *system_; }
  const std::vector<std::string>& names() const { return names_; }              ///< state names
  const std::vector<std::string>& error_names() const { return error_names_; }  ///< names in the error form
  bool has_error_form() const { return system_->text.error_form.has_value(); }

  /// n: typical size of each state, from its region; used to compare sizes of states.
  const Eigen::VectorXd& units() const { return units_; }

  /// This and the following throw SystemError if an expression has no finite value.
  Eigen::VectorXd rate(const SystemPoint& point) const;
  /// F of linearize(), without computing H.
  Eigen::MatrixXd rate_derivative(const SystemPoint& point) const;
  /// With exact derivatives.
  LinearizedSystem linearize(const SystemPoint& point) const;
  /// In the coordinates of the stated error form; with exact derivatives if there is none.
  LinearizedSystem error_form(const SystemPoint& point) const;
  /// The directions named in the file at this point, those of single landmarks first; `of_error_form`: those
  /// of the error form.
  std::vector<NamedDirection> directions(const SystemPoint& point, bool of_error_form) const;

  /// Permanently sets an atom that is neither state nor input.
  void hold(ExpressionGraph::Slot atom, double value) { held_.emplace_back(atom, value); }

  /// Calls back once for the vehicle and once for each landmark and anchor, with every quantity of its owner
  /// evaluated. `of`: index of the landmark or anchor; `first`: index of its first state (-1: an anchor).
  /// `only`: mask by slot of quantities to evaluate; null: all.
  template <class Visit>
  void visit(const SystemPoint& point, bool with_gradients, Visit&& visit,
             const std::vector<bool>* only = nullptr) const;

 private:
  int first_state(int landmark) const;

  const SymbolicSystem* system_;
  int landmarks_, anchors_, states_, measurements_;
  std::vector<std::string> names_, error_names_;
  Eigen::VectorXd units_;
  std::vector<std::pair<ExpressionGraph::Slot, double>> held_;
  std::vector<bool> for_rates_;                     // mask by slot
  mutable ExpressionGraph::Evaluation evaluation_;  // scratch
};

template <class Visit>
void SystemInstance::visit(const SystemPoint& point, bool with_gradients, Visit&& visit,
                           const std::vector<bool>* only) const {
  const SymbolicSystem& s = *system_;
  auto& e = evaluation_;
  s.graph.prepare(e, s.columns());
  const auto put = [&](const std::vector<ExpressionGraph::Slot>& slots, const Eigen::VectorXd& from,
                       int first) {
    for (std::size_t i = 0; i < slots.size(); ++i) e.value[slots[i]] = from[first + static_cast<int>(i)];
  };
  for (const auto& [slot, value] : s.parameters) e.value[slot] = value;
  for (const auto& [slot, value] : held_) e.value[slot] = value;
  put(s.inputs, point.u, 0);
  put(s.vehicle.states, point.x, 0);
  s.graph.evaluate(Owner::vehicle, e, with_gradients, only);
  visit(Owner::vehicle, s.vehicle, 0, 0, e);
  for (int i = 0; i < landmarks_; ++i) {
    put(s.landmark.states, point.x, first_state(i));
    s.graph.evaluate(Owner::landmark, e, with_gradients, only);
    visit(Owner::landmark, s.landmark, i, first_state(i), e);
  }
  for (int i = 0; i < anchors_; ++i) {
    put(s.anchor.states, point.anchors, i * static_cast<int>(s.anchor.states.size()));
    s.graph.evaluate(Owner::anchor, e, with_gradients, only);
    visit(Owner::anchor, s.anchor, i, -1, e);
  }
}

}  // namespace incognita
