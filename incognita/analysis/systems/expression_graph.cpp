#include "incognita/analysis/systems/expression_graph.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "incognita/analysis/systems/parse_expression.hpp"

namespace incognita {
namespace {

// Nodes of expressions that take the algebra a second or two
constexpr std::size_t largest_expression = 20'000, most_nodes = 3'000'000;
constexpr std::size_t most_factors = 64;  // limit per product; the size of its derivative is quadratic

void symbols_in(const GiNaC::ex& e, GiNaC::exset& found) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    found.insert(e);
    return;
  }
  for (std::size_t i = 0; i < e.nops(); ++i) symbols_in(e.op(i), found);
}

bool has_long_product(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::mul>(e) && e.nops() > most_factors) return true;
  for (std::size_t i = 0; i < e.nops(); ++i)
    if (has_long_product(e.op(i))) return true;
  return false;
}

}  // namespace

void ExpressionGraph::spend(std::size_t nodes, SourceLocation location) {
  spent_ += nodes;
  if (nodes > largest_expression || spent_ > most_nodes)
    throw SystemTooLarge(location,
                         "too large for symbolic derivatives: more than " +
                             std::to_string(nodes > largest_expression ? largest_expression : most_nodes) +
                             " terms" + (nodes > largest_expression ? " in one expression" : ""));
}

ExpressionGraph::Slot ExpressionGraph::add_atom(const std::string& name, Owner owner, SourceLocation location,
                                                int column) {
  Quantity quantity;
  quantity.name = name;
  quantity.owner = owner;
  quantity.location = location;
  quantity.symbol = GiNaC::realsymbol(name);
  quantity.column = column;
  quantity.named = true;
  slots_[quantity.symbol] = size();
  quantities_.push_back(std::move(quantity));
  return size() - 1;
}

ExpressionGraph::Slot ExpressionGraph::define(const std::string& name, Owner owner,
                                              const GiNaC::ex& expression, SourceLocation location,
                                              bool named) {
  spend(tree_size(expression, largest_expression + 1), location);
  if (has_long_product(expression))
    throw SystemTooLarge(location, "a product of more than " + std::to_string(most_factors) +
                                       " factors: name parts of it under definitions");
  GiNaC::exset names;
  symbols_in(expression, names);
  Quantity quantity;
  quantity.owner = owner;
  quantity.named = named;
  try {
    const auto slot = [&](const GiNaC::symbol& s) { return slot_of(s); };
    quantity.tape.emplace(expression, slot);
    // By slot, not in the algebra's order, so that sums are reproducible
    std::map<Slot, GiNaC::ex> by_slot;
    for (const GiNaC::ex& symbol : names) by_slot.emplace(slots_.at(symbol), symbol);
    for (const auto& [from, symbol] : by_slot) {
      const GiNaC::ex partial = expression.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
      spend(tree_size(partial, largest_expression + 1), location);
      quantity.partials.emplace_back(from, partial);
      quantity.partial_tapes.emplace_back(partial, slot);
      quantity.owner = std::max(quantity.owner, (*this)[from].owner);
    }
  } catch (const SystemError&) {
    throw;
  } catch (const std::exception&) {
    throw SystemError(location, "`" + name + "` " + no_value);
  }
  quantity.name = name;
  quantity.location = location;
  quantity.symbol = GiNaC::realsymbol(name);
  quantity.expression = expression;
  slots_[quantity.symbol] = size();
  quantities_.push_back(std::move(quantity));
  return size() - 1;
}

GiNaC::ex ExpressionGraph::parse(const ExpressionText& text, Owner sees) const {
  std::map<std::string, GiNaC::ex> names;
  for (const Quantity& q : quantities_)
    if (q.named && (q.owner == Owner::vehicle || q.owner == sees)) names[q.name] = q.symbol;
  return parse_expression(text, names);
}

std::optional<ExpressionGraph::Slot> ExpressionGraph::find(const std::string& name, Owner sees) const {
  for (Slot slot = 0; slot < size(); ++slot)
    if ((*this)[slot].named && (*this)[slot].name == name &&
        ((*this)[slot].owner == Owner::vehicle || (*this)[slot].owner == sees))
      return slot;
  return std::nullopt;
}

ExpressionGraph::Slot ExpressionGraph::slot_of(const GiNaC::symbol& symbol) const {
  return slots_.at(symbol);
}

bool ExpressionGraph::is_affine_in(const GiNaC::ex& expression, const std::vector<Slot>& atoms) const {
  for (const Slot one : atoms) {
    const GiNaC::ex first = derivative(expression, one);
    if (first.has(GiNaC::abs(GiNaC::wild()))) return false;
    for (const Slot other : atoms)
      if (!derivative(first, other).is_zero()) return false;
  }
  return true;
}

GiNaC::ex ExpressionGraph::derivative(const GiNaC::ex& expression, Slot atom) const {
  std::map<Slot, GiNaC::ex> known;
  return derivative(expression, atom, known);
}

GiNaC::ex ExpressionGraph::derivative(const GiNaC::ex& expression, Slot atom,
                                      std::map<Slot, GiNaC::ex>& known) const {
  GiNaC::exset names;
  symbols_in(expression, names);
  GiNaC::ex total = 0;
  for (const GiNaC::ex& symbol : names) {
    const Slot slot = slots_.at(symbol);
    auto inner = known.find(slot);
    if (inner == known.end()) {
      const Quantity& quantity = (*this)[slot];
      const GiNaC::ex value = quantity.expression ? derivative(*quantity.expression, atom, known)
                                                  : GiNaC::ex(slot == atom ? 1 : 0);
      inner = known.emplace(slot, value).first;
    }
    if (inner->second.is_zero()) continue;
    total += expression.diff(GiNaC::ex_to<GiNaC::symbol>(symbol)) * inner->second;
    if (tree_size(total, largest_expression + 1) > largest_expression)
      throw SystemTooLarge(SourceLocation{},
                           "a derivative of more than " + std::to_string(largest_expression) + " terms");
  }
  return total;
}

void ExpressionGraph::prepare(Evaluation& evaluation, int columns) const {
  const auto before = static_cast<Slot>(evaluation.value.size());
  evaluation.value.resize(static_cast<std::size_t>(size()), 0.0);
  for (Eigen::MatrixXd* M : {&evaluation.gradient, &evaluation.terms}) {
    if (M->cols() == size() && M->rows() == columns) continue;
    const Eigen::MatrixXd old = std::move(*M);
    *M = Eigen::MatrixXd::Zero(columns, size());
    if (old.rows() == columns) M->leftCols(old.cols()) = old;
  }
  for (Slot slot = before; slot < size(); ++slot) {
    const int column = (*this)[slot].column;
    if (column >= 0) evaluation.gradient(column, slot) = evaluation.terms(column, slot) = 1;
  }
}

/// Names of the atoms of a quantity whose value is exactly 0; drawn values never are.
std::vector<std::string> ExpressionGraph::zeros_in(Slot slot, const Evaluation& e) const {
  const std::vector<bool> needed = needed_for({slot});
  std::vector<std::string> zeros;
  for (Slot atom = 0; atom < slot; ++atom) {
    const Quantity& q = (*this)[atom];
    if (!needed[static_cast<std::size_t>(atom)] || q.expression) continue;
    if (e.value[static_cast<std::size_t>(atom)] != 0) continue;
    const std::string name = "`" + q.name.substr(0, q.name.find('(')) + "`";  // a copy is named v(2)
    if (std::find(zeros.begin(), zeros.end(), name) == zeros.end()) zeros.push_back(name);
  }
  return zeros;
}

void ExpressionGraph::refuse_value(Slot slot, const Evaluation& e, const char* what) const {
  std::string zeros;
  for (const std::string& name : zeros_in(slot, e)) zeros += (zeros.empty() ? "" : " and ") + name;
  throw SystemError(
      (*this)[slot].location,
      "`" + (*this)[slot].name + "` " + what + " at the operating point" +
          (zeros.empty() ? "" : ", with " + zeros + " at 0") +
          ": a division by zero, or a function outside its domain; choose " +
          (zeros.empty() ? "another region"
                         : "another value, range or motion for " + zeros + ", or another region"));
}

std::vector<bool> ExpressionGraph::needed_for(const std::vector<Slot>& slots) const {
  std::vector<bool> needed(static_cast<std::size_t>(size()));
  for (const Slot slot : slots) needed[static_cast<std::size_t>(slot)] = true;
  for (Slot slot = size() - 1; slot >= 0; --slot) {
    if (!needed[static_cast<std::size_t>(slot)]) continue;
    for (const auto& partial : (*this)[slot].partials) needed[static_cast<std::size_t>(partial.first)] = true;
  }
  return needed;
}

void ExpressionGraph::evaluate(Owner owner, Evaluation& e, bool with_gradients,
                               const std::vector<bool>* only) const {
  for (Slot slot = 0; slot < size(); ++slot) {
    const Quantity& q = (*this)[slot];
    if (q.owner != owner || !q.expression) continue;
    if (only && !(*only)[static_cast<std::size_t>(slot)]) continue;
    const auto at = static_cast<std::size_t>(slot);
    e.value[at] = q.tape->run(e.value, e.scratch);
    if (!std::isfinite(e.value[at])) refuse_value(slot, e, "is not finite");
    if (!with_gradients) continue;
    e.gradient.col(slot).setZero();
    e.terms.col(slot).setZero();
    for (std::size_t i = 0; i < q.partials.size(); ++i) {
      const double partial = q.partial_tapes[i].run(e.value, e.scratch);
      if (!std::isfinite(partial)) refuse_value(slot, e, "has no finite derivative");
      e.gradient.col(slot) += partial * e.gradient.col(q.partials[i].first);
      e.terms.col(slot) += std::abs(partial) * e.terms.col(q.partials[i].first);
    }
  }
}

}  // namespace incognita
