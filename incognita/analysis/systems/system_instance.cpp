#include "incognita/analysis/systems/system_instance.hpp"

#include <cmath>
#include <stdexcept>

namespace incognita {
namespace {

using Block = SymbolicSystem::Block;
using Evaluation = ExpressionGraph::Evaluation;

void append_names(std::vector<std::string>& names, const std::vector<std::string>& of_block, int landmark) {
  for (const std::string& name : of_block)
    names.push_back(landmark < 0 ? name : name + "_" + std::to_string(landmark + 1));
}

std::vector<std::string> names_of(const std::vector<NamedExpression>& states) {
  std::vector<std::string> names;
  names.reserve(states.size());
  for (const NamedExpression& state : states) names.push_back(state.name);
  return names;
}

/// Width of its region; for a given state, its magnitude.
double unit_of(const NamedRange& range) {
  const double width = range.high - range.low, size = std::abs(range.high);
  return width > 0 ? width : size > 0 ? size : 1;
}

/// Writes rows of a matrix over all states from a block's columns: the vehicle's states, then one landmark's.
struct RowWriter {
  int vehicle_states;
  int first;  // first state of the landmark; -1 without one

  int column(int of_block) const {
    return of_block < vehicle_states ? of_block : first + of_block - vehicle_states;
  }
  void gradient(Eigen::MatrixXd& M, int row, const Eigen::MatrixXd::ConstColXpr& gradient) const {
    M.row(row).head(vehicle_states) = gradient.head(vehicle_states);
    const auto own = gradient.size() - vehicle_states;
    if (first >= 0 && own > 0) M.row(row).segment(first, own) = gradient.tail(own);
  }
};

}  // namespace

SystemInstance::SystemInstance(const SymbolicSystem& system, int landmarks, int anchors)
    : system_(&system), landmarks_(landmarks), anchors_(anchors) {
  const SystemText& text = system.text;
  if (landmarks < 0 || anchors < 0)
    throw std::invalid_argument("the numbers of features and anchors must be 0 or more");
  if (landmarks > 0 && !text.landmark)
    throw std::invalid_argument("`" + text.name + "` has no [landmark] block, so that it has no features");
  if (anchors > 0 && !text.anchor)
    throw std::invalid_argument(
        "`" + text.name + "` has no [anchor] block, so that it has no anchors" +
        (text.representation == "relative" ? ": a relative map has no world frame" : ""));
  const auto count = [](const Block& block) { return static_cast<int>(block.measurements.size()); };
  states_ = static_cast<int>(system.vehicle.states.size() + landmarks * system.landmark.states.size());
  measurements_ = count(system.vehicle) + landmarks * count(system.landmark) + anchors * count(system.anchor);
  if (measurements_ == 0)
    throw std::invalid_argument("nothing is measured: the numbers of features and anchors are 0");
  std::vector<ExpressionGraph::Slot> rates = system.vehicle.rates;
  rates.insert(rates.end(), system.landmark.rates.begin(), system.landmark.rates.end());
  for_rates_ = system.graph.needed_for(rates);
  units_.resize(states_);
  int state = 0;
  for (const NamedRange& range : system.vehicle.region) units_[state++] = unit_of(range);
  for (int i = 0; i < landmarks; ++i)
    for (const NamedRange& range : system.landmark.region) units_[state++] = unit_of(range);
  append_names(names_, names_of(text.vehicle.states), -1);
  append_names(error_names_, system.vehicle_error_names, -1);
  for (int i = 0; i < landmarks; ++i) {
    append_names(names_, names_of(text.landmark->states), i);
    append_names(error_names_, system.landmark_error_names, i);
  }
}

int SystemInstance::first_state(int landmark) const {
  return static_cast<int>(system_->vehicle.states.size() + landmark * system_->landmark.states.size());
}

Eigen::VectorXd SystemInstance::rate(const SystemPoint& point) const {
  Eigen::VectorXd rate(states_);
  const auto take = [&](Owner, const Block& block, int, int first, const Evaluation& e) {
    for (std::size_t i = 0; i < block.rates.size(); ++i)
      rate[first + static_cast<int>(i)] = e.value[block.rates[i]];
  };
  visit(point, false, take, &for_rates_);
  return rate;
}

Eigen::MatrixXd SystemInstance::rate_derivative(const SystemPoint& point) const {
  const int vehicle_states = static_cast<int>(system_->vehicle.states.size());
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(states_, states_);
  const auto take = [&](Owner owner, const Block& block, int, int first, const Evaluation& e) {
    const RowWriter writer{vehicle_states, owner == Owner::landmark ? first : -1};
    for (std::size_t i = 0; i < block.rates.size(); ++i)
      writer.gradient(F, first + static_cast<int>(i), e.gradient.col(block.rates[i]));
  };
  visit(point, true, take, &for_rates_);
  return F;
}

LinearizedSystem SystemInstance::linearize(const SystemPoint& point) const {
  const int vehicle_states = static_cast<int>(system_->vehicle.states.size());
  LinearizedSystem l{Eigen::MatrixXd::Zero(states_, states_), Eigen::MatrixXd::Zero(measurements_, states_),
                     Eigen::VectorXd(measurements_), Eigen::MatrixXd::Zero(states_, states_),
                     Eigen::MatrixXd::Zero(measurements_, states_)};
  int row = 0;
  visit(point, true, [&](Owner owner, const Block& block, int, int first, const Evaluation& e) {
    const RowWriter writer{vehicle_states, owner == Owner::landmark ? first : -1};
    for (std::size_t i = 0; i < block.rates.size(); ++i) {
      writer.gradient(l.F, first + static_cast<int>(i), e.gradient.col(block.rates[i]));
      writer.gradient(l.F_terms, first + static_cast<int>(i), e.terms.col(block.rates[i]));
    }
    for (std::size_t i = 0; i < block.measurements.size(); ++i, ++row) {
      writer.gradient(l.H, row, e.gradient.col(block.measurements[i]));
      writer.gradient(l.H_terms, row, e.terms.col(block.measurements[i]));
      l.sigma[row] = block.sigmas[i];
    }
  });
  return l;
}

LinearizedSystem SystemInstance::error_form(const SystemPoint& point) const {
  if (!has_error_form()) return linearize(point);
  const int vehicle_states = static_cast<int>(system_->vehicle.states.size());
  LinearizedSystem l{Eigen::MatrixXd::Zero(states_, states_), Eigen::MatrixXd::Zero(measurements_, states_),
                     Eigen::VectorXd(measurements_), Eigen::MatrixXd::Zero(states_, states_),
                     Eigen::MatrixXd::Zero(measurements_, states_)};
  int row = 0;
  visit(point, false, [&](Owner owner, const Block& block, int, int first, const Evaluation& e) {
    const RowWriter writer{vehicle_states, owner == Owner::landmark ? first : -1};
    for (const auto& entry : block.error_F)
      l.F(writer.column(entry.row), writer.column(entry.column)) = e.value[entry.value];
    for (const auto& entry : block.error_H)
      l.H(row + entry.row, writer.column(entry.column)) = e.value[entry.value];
    for (const double sigma : block.sigmas) l.sigma[row++] = sigma;
  });
  l.F_terms = l.F.cwiseAbs();
  // The terms of stated entries are unknown: each is assumed as large as the whole matrix
  l.H_terms.setConstant(l.H.norm());
  return l;
}

std::vector<NamedDirection> SystemInstance::directions(const SystemPoint& point, bool of_error_form) const {
  const auto& directions =
      of_error_form && has_error_form() ? system_->error_directions : system_->directions;
  std::vector<NamedDirection> all(directions.size());
  std::vector<NamedDirection> of_landmarks;
  for (std::size_t d = 0; d < directions.size(); ++d)
    all[d] = {directions[d].name, Eigen::VectorXd::Zero(states_)};
  visit(point, false, [&](Owner owner, const Block&, int which, int first, const Evaluation& e) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      if (owner == Owner::vehicle)
        for (const auto& [state, value] : directions[d].vehicle) all[d].vector[state] = e.value[value];
      if (owner != Owner::landmark) continue;
      Eigen::VectorXd& whole = all[d].vector;
      NamedDirection own{directions[d].name + " of feature " + std::to_string(which + 1),
                         Eigen::VectorXd::Zero(states_), true};
      for (const auto& [state, value] : directions[d].landmark)
        (directions[d].each_landmark ? own.vector : whole)[first + state] = e.value[value];
      if (directions[d].each_landmark) of_landmarks.push_back(std::move(own));
    }
  });
  for (std::size_t d = 0; d < directions.size(); ++d)
    if (!directions[d].each_landmark) of_landmarks.push_back(std::move(all[d]));
  return of_landmarks;
}

}  // namespace incognita
