#include "incognita/analysis/observability/lie_derivatives.hpp"

#include <algorithm>
#include <set>

#include "incognita/analysis/systems/canonical_expression.hpp"
#include "incognita/analysis/systems/lie_algebra.hpp"

namespace incognita {
namespace {

using Slot = ExpressionGraph::Slot;

/// A derivative of one measurement; it has one row per landmark or anchor.
struct Word {
  Owner owner = Owner::vehicle;
  Slot slot = 0;
  int order = 0;
  SourceLocation location;
  bool raised_rank = false;
};

/// Differentials of all words at one point, and their span.
class PointRows {
 public:
  PointRows(SystemPoint point, const std::vector<Eigen::VectorXd>& other_inputs)
      : point_(std::move(point)), other_inputs_(&other_inputs) {}

  /// Re-evaluates all quantities after the algebra has grown.
  void refresh(const LieAlgebra& algebra, const SystemInstance& shape);
  /// Adds the rows of a word; returns the number of new directions.
  int add(const Word& word, const SystemInstance& shape);
  /// Determines the rank of all rows so far.
  void settle(const NullSpaceSettings& settings) { space_ = null_space(rows_, settings); }

  const NullSpace& space() const { return space_; }
  int directions() const { return static_cast<int>(span_.cols()); }

 private:
  struct Gradients {
    Owner owner;
    int first;
    Eigen::MatrixXd gradient, terms;
  };

  SystemPoint point_;
  const std::vector<Eigen::VectorXd>* other_inputs_;
  std::vector<Gradients> gradients_;
  NoisyRows rows_;
  NullSpace space_;
  Eigen::MatrixXd span_;  // orthonormal columns, in the units of the states
  double largest_ = 0;    // largest row norm so far, likewise
};

void PointRows::refresh(const LieAlgebra& algebra, const SystemInstance& shape) {
  gradients_.clear();
  // The algebra's system is the instance's, extended by new quantities
  const SymbolicSystem& s = algebra.system();
  SystemInstance grown(s, shape.landmarks(), shape.anchors());
  for (std::size_t set = 0; set < algebra.input_copies().size(); ++set)
    for (std::size_t i = 0; i < algebra.input_copies()[set].size(); ++i)
      if (algebra.input_copies()[set][i] >= 0)
        grown.hold(algebra.input_copies()[set][i], (*other_inputs_)[set][static_cast<Eigen::Index>(i)]);
  grown.visit(point_, true, [&](Owner owner, const SymbolicSystem::Block&, int, int first, const auto& e) {
    gradients_.push_back({owner, first, e.gradient, e.terms});
  });
}

int PointRows::add(const Word& word, const SystemInstance& shape) {
  const int n = shape.states();
  const Eigen::VectorXd& units = shape.units();
  const auto vehicle = static_cast<Eigen::Index>(shape.system().vehicle.states.size());
  if (span_.rows() != n) span_.resize(n, 0);
  int added = 0;
  for (const Gradients& g : gradients_) {
    if (g.owner != word.owner) continue;
    const auto spread = [&](const Eigen::VectorXd& of_block) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
      row.head(vehicle) = of_block.head(vehicle);
      const auto own = of_block.size() - vehicle;
      if (g.owner == Owner::landmark) row.segment(g.first, own) = of_block.tail(own);
      return row;
    };
    const Eigen::VectorXd row = spread(g.gradient.col(word.slot)), in_units = row.cwiseProduct(units);
    // Where values cancel, as at an equilibrium, a zero is computed as rounding of the size of other rows
    largest_ = std::max(largest_, in_units.norm());
    const Eigen::VectorXd noise =
        (1e-13 * n * spread(g.terms.col(word.slot))).cwiseMax(1e-14 * largest_ * units.cwiseInverse());
    rows_.append({row.transpose(), noise.transpose(), false, {}});
    if ((row.array().abs() <= noise.array()).all()) continue;
    Eigen::VectorXd rest = in_units.normalized();
    for (int twice = 0; twice < 2; ++twice) rest -= span_ * (span_.transpose() * rest);
    constexpr double nothing_new = 1e-8;
    if (rest.norm() < nothing_new) continue;
    span_.conservativeResize(n, span_.cols() + 1);
    span_.rightCols(1) = rest.normalized();
    ++added;
  }
  return added;
}

std::string owner_name(Owner owner) {
  return owner == Owner::vehicle ? "vehicle" : owner == Owner::landmark ? "landmark" : "anchor";
}

/// Collects all derived quantities that an expression depends on.
void parts_of(const SymbolicSystem& system, const GiNaC::ex& e, Slot first_new, std::set<Slot>& parts) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    const Slot slot = system.graph.slot_of(GiNaC::ex_to<GiNaC::symbol>(e));
    const auto& q = system.graph[slot];
    if (slot >= first_new && q.expression && parts.insert(slot).second)
      parts_of(system, *q.expression, first_new, parts);
    return;
  }
  for (std::size_t i = 0; i < e.nops(); ++i) parts_of(system, e.op(i), first_new, parts);
}

std::string equation(const ExpressionGraph::Quantity& q, const LatexNames& names) {
  return names(q.name) + " = " + in_latex(*q.expression, names);
}

LieRow row_of(const SymbolicSystem& system, const Word& word, Slot first_new, const LatexNames& names) {
  const auto& q = system.graph[word.slot];
  LieRow row{q.name, owner_name(word.owner), word.order, q.name, {}, "", {}, word.raised_rank};
  if (!q.expression) return row;
  row.expression = written(*q.expression);
  std::set<Slot> parts;
  parts_of(system, *q.expression, first_new, parts);
  for (const Slot part : parts)
    row.definitions.emplace_back(system.graph[part].name, written(*system.graph[part].expression));
  if (!word.raised_rank) return row;
  row.latex = equation(q, names);
  std::set<Slot> all;
  parts_of(system, *q.expression, 0, all);
  for (const Slot part : all) row.latex_definitions.push_back(equation(system.graph[part], names));
  return row;
}

/// Breadth-first search: every word that raised the rank is differentiated along every field.
class Search {
 public:
  Search(const SystemInstance& instance, const SystemMotion& motion, RandomStream& random)
      : instance_(instance), algebra_(instance.system(), static_cast<int>(motion.other_inputs.size())) {
    points_.emplace_back(motion.segments.front().start, motion.other_inputs);
    SystemPoint elsewhere = motion.segments.front().start;
    int state = 0;
    const SymbolicSystem& s = instance.system();
    for (const NamedRange& r : s.vehicle.region) elsewhere.x[state++] = random.uniform(r.low, r.high);
    points_.emplace_back(elsewhere, motion.other_inputs);
    first_new_ = algebra_.system().graph.size();
  }

  void run(const LieSettings& settings, const NullSpaceSettings& rank, LieAnalysis& result) {
    std::vector<Word> front = measurements();
    keep(front, rank, result);
    for (int order = 1; order <= settings.max_order && !front.empty(); ++order) {
      if (full()) break;
      std::vector<Word> next;
      for (const Word& word : front)
        for (int field = 0; field < static_cast<int>(algebra_.fields().size()); ++field) {
          const Slot slot = algebra_.derive(word.slot, field, word.location);
          if (slot >= 0 && !seen(slot, word.owner))
            next.push_back({word.owner, slot, order, word.location, false});
        }
      result.orders_examined = order;
      keep(next, rank, result);
      front = std::move(next);
    }
    result.missed = !full() && std::any_of(points_.begin(), points_.end(), [](const PointRows& p) {
      return p.directions() < p.space().rank || p.space().ambiguous;
    });
    result.closed = full() || (front.empty() && !result.missed);
  }

  void report(LieAnalysis& result) const {
    result.space = points_[0].space();
    result.generic_rank = points_[1].space().rank;
    result.inputs_nonlinear = algebra_.inputs_nonlinear();
    for (const VectorField& field : algebra_.fields()) result.fields.push_back(field.name);
    const LatexNames names = latex_names(algebra_.system());
    for (const Word& word : words_) result.rows.push_back(row_of(algebra_.system(), word, first_new_, names));
  }

 private:
  bool full() const {
    return std::all_of(points_.begin(), points_.end(),
                       [&](const PointRows& p) { return p.space().rank == instance_.states(); });
  }

  bool seen(Slot slot, Owner owner) const {
    return std::any_of(words_.begin(), words_.end(),
                       [&](const Word& w) { return w.slot == slot && w.owner == owner; });
  }

  std::vector<Word> measurements() const {
    std::vector<Word> words;
    const SymbolicSystem& s = algebra_.system();
    const auto add = [&](Owner owner, const SymbolicSystem::Block& block, const BlockText& text) {
      for (std::size_t i = 0; i < block.measurements.size(); ++i)
        words.push_back({owner, block.measurements[i], 0, text.measurements[i].expression.location, false});
    };
    add(Owner::vehicle, s.vehicle, s.text.vehicle);
    if (instance_.landmarks() > 0) add(Owner::landmark, s.landmark, *s.text.landmark);
    if (instance_.anchors() > 0) add(Owner::anchor, s.anchor, *s.text.anchor);
    const std::size_t own = words.size();
    for (std::size_t i = 0; i < own; ++i)
      for (const auto& other : algebra_.other_measurements())
        if (other.original == words[i].slot)
          words.push_back({words[i].owner, other.slot, 0, words[i].location, false});
    return words;
  }

  /// Adds the words, and keeps in the list those that raised the rank at some point.
  void keep(std::vector<Word>& words, const NullSpaceSettings& rank, LieAnalysis& result) {
    for (PointRows& point : points_) point.refresh(algebra_, instance_);
    std::vector<Word> raising;
    for (Word& word : words) {
      for (PointRows& point : points_)
        if (point.add(word, instance_) > 0) word.raised_rank = true;
      words_.push_back(word);
      if (!word.raised_rank) continue;
      raising.push_back(word);
      result.order = std::max(result.order, word.order);
    }
    for (PointRows& point : points_) point.settle(rank);
    words = std::move(raising);
  }

  const SystemInstance& instance_;
  LieAlgebra algebra_;
  std::vector<PointRows> points_;
  std::vector<Word> words_;
  Slot first_new_ = 0;
};

}  // namespace

LieAnalysis analyze_lie(const SystemInstance& instance, const SystemMotion& motion, RandomStream& random,
                        const LieSettings& settings, const NullSpaceSettings& rank) {
  LieAnalysis result;
  Search search(instance, motion, random);
  search.run(settings, rank, result);
  search.report(result);
  return result;
}

}  // namespace incognita
