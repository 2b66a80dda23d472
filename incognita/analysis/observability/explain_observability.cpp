#include "incognita/analysis/observability/explain_observability.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "incognita/analysis/observability/observability_matrices.hpp"

namespace incognita {
namespace {

/// Accepts directions that are independent of those accepted before, in scaled coordinates.
class Independent {
 public:
  explicit Independent(const NullSpace& space) : space_(space), span_(space.column_scale.size(), 0) {}

  bool add(const Eigen::VectorXd& direction) {
    const Eigen::VectorXd scaled = direction.cwiseQuotient(space_.column_scale);
    if (!(scaled.norm() > 0)) return false;
    const Eigen::VectorXd unit = scaled.normalized();
    const Eigen::VectorXd rest = unit - span_ * (span_.transpose() * unit);
    if (rest.norm() < 1e-6) return false;
    span_.conservativeResize(Eigen::NoChange, span_.cols() + 1);
    span_.rightCols(1) = rest.normalized();
    return true;
  }
  bool full() const { return span_.cols() >= space_.nullity; }

 private:
  const NullSpace& space_;
  Eigen::MatrixXd span_;
};

/// Combinations of global directions that lie in the space, e.g. a rotation about an anchor: one about the
/// origin plus a shift. The last named lead.
std::vector<NamedDirection> combinations(const NullSpace& space, const std::vector<NamedDirection>& named) {
  std::vector<const NamedDirection*> whole;
  for (auto d = named.rbegin(); d != named.rend(); ++d)
    if (!d->of_landmark && d->vector.norm() > 0) whole.push_back(&*d);
  const auto n = space.column_scale.size(), count = static_cast<Eigen::Index>(whole.size());
  if (count == 0 || space.nullity == 0) return {};
  Eigen::MatrixXd scaled(n, count);
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < count; ++i) {
    scaled.col(i) = whole[static_cast<std::size_t>(i)]->vector.cwiseQuotient(space.column_scale);
    names.push_back(whole[static_cast<std::size_t>(i)]->name);
  }
  const Eigen::MatrixXd outside = scaled - space.scaled_null * (space.scaled_null.transpose() * scaled);
  NoisyRows rows = NoisyRows::exact(outside);
  rows.noise.setConstant(1e-12 * scaled.colwise().norm().maxCoeff());
  rows.weighed = true;
  std::vector<NamedDirection> found;
  for (const Eigen::VectorXd& c : readable_basis(null_space(rows))) {
    NamedDirection direction{written_combination(c, names), Eigen::VectorXd::Zero(n)};
    for (Eigen::Index i = 0; i < count; ++i)
      direction.vector += c[i] * whole[static_cast<std::size_t>(i)]->vector;
    found.push_back(std::move(direction));
  }
  return found;
}

std::string counted(int count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string list_of(const std::vector<UnobservableDirection>& directions) {
  std::string text;
  for (const auto& d : directions) text += (text.empty() ? "" : ", ") + d.name;
  return text;
}

}  // namespace

std::vector<UnobservableDirection> named_directions(const NullSpace& space,
                                                    const std::vector<NamedDirection>& named,
                                                    const std::vector<std::string>& states) {
  std::vector<UnobservableDirection> directions;
  Independent kept(space);
  const auto take = [&](const std::string& name, const Eigen::VectorXd& vector) {
    if (!kept.full() && kept.add(vector)) directions.push_back({name, vector});
  };
  for (const NamedDirection& d : named)
    if (space.contains(d.vector)) take(d.name, d.vector);
  for (const NamedDirection& d : combinations(space, named))
    if (space.contains(d.vector)) take(d.name, d.vector);
  for (Eigen::Index i = 0; i < space.column_scale.size(); ++i) {
    const Eigen::VectorXd alone = Eigen::VectorXd::Unit(space.column_scale.size(), i);
    if (space.contains(alone)) take(states[static_cast<std::size_t>(i)], alone);
  }
  for (const Eigen::VectorXd& v : readable_basis(space)) take(written_combination(v, states), v);
  // Completes the basis if rounding kept the others from spanning the space
  for (Eigen::Index i = 0; i < space.nullity; ++i) {
    const Eigen::VectorXd v = space.column_scale.cwiseProduct(space.scaled_null.col(i));
    take(written_combination(v, states), v);
  }
  return directions;
}

ObservableSpace observable_space(const NoisyRows& rows, const std::vector<NamedDirection>& named,
                                 const std::vector<std::string>& states, const NullSpaceSettings& settings) {
  ObservableSpace seen{null_space(rows, settings), {}};
  seen.directions = named_directions(seen.space, named, states);
  return seen;
}

namespace {

/// Differences between ranks are explained only if both are clear.
bool both_clear(const NullSpace& a, const NullSpace& b) { return !a.ambiguous && !b.ambiguous; }

constexpr const char* not_clear = "one of these ranks is ambiguous.";
constexpr const char* not_known = "the cause is unknown, possibly rounding.";

bool differ(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return ((a - b).array().abs() > 1e-6 * (a.array().abs() + b.array().abs())).any();
}

/// Whether F or H change while the inputs are held.
bool form_changes(const SystemInstance& instance, const std::vector<MotionSample>& samples) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].point.u != samples[i - 1].point.u) continue;
    const LinearizedSystem before = instance.linearize(samples[i - 1].point),
                           now = instance.linearize(samples[i].point);
    if (differ(before.F, now.F) || differ(before.H, now.H)) return true;
  }
  return false;
}

/// SOM against the local observability along the motion: SOM freezes H while F propagates the state.
void compare_with_motion(const ObservabilityAnalysis& a, bool changes, std::vector<std::string>& said) {
  const ObservableSpace& stripped = a.segments.back().stripped;
  const int local = a.local.space.nullity, frozen = stripped.space.nullity;
  if (local == frozen) return;
  const bool more = frozen < local;
  const std::string cause =
      !both_clear(stripped.space, a.local.space) ? not_clear
      : !changes                                 ? not_known
      : more
          ? "within a segment SOM keeps H constant while F propagates the vehicle, so that directions without effect on any single measurement seem observable. A filter that relinearizes at each estimate is overconfident in them."
          : "the change of H within a segment, which SOM ignores, makes the rest observable.";
  said.push_back("SOM over " + counted(static_cast<int>(a.segments.size()), "segment", "segments") +
                 " has nullity " + std::to_string(frozen) +
                 (more ? "" : " (" + list_of(stripped.directions) + ")") + ", the motion nullity " +
                 std::to_string(local) + (more ? " (" + list_of(a.local.directions) + ")" : "") + ": " +
                 cause);
}

void compare_som_and_tom(const ObservabilityAnalysis& a, std::vector<std::string>& said) {
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    const SegmentAnalysis& s = a.segments[k];
    if (s.stripped.space.nullity == s.total.space.nullity) continue;
    const std::string cause =
        !both_clear(s.stripped.space, s.total.space) ? not_clear
        : s.condition_holds ? "condition (4.9) holds for each segment, so that one of the ranks is wrong."
                            : "condition (4.9) does not hold, so that SOM cannot replace TOM.";
    said.push_back("After segment " + std::to_string(k + 1) + " SOM has nullity " +
                   std::to_string(s.stripped.space.nullity) + " and TOM " +
                   std::to_string(s.total.space.nullity) + ": " + cause);
  }
}

std::string cause_of_lie(const ObservabilityAnalysis& a, bool inputs_vary) {
  const LieAnalysis& lie = *a.lie;
  if (!both_clear(lie.space, a.local.space)) return not_clear;
  if (lie.space.nullity < a.local.space.nullity)
    return inputs_vary ? "other inputs of this kind make more observable than the inputs of this motion."
                       : not_known;
  if (!lie.closed) return "the order of the Lie derivatives was limited.";
  if (lie.space.rank < lie.generic_rank)
    return "the motion leaves the state at which the Lie derivatives are evaluated, and more is observable elsewhere.";
  return lie.inputs_nonlinear ? "the Lie derivatives were evaluated at a few drawn inputs only." : not_known;
}

void compare_with_lie(const ObservabilityAnalysis& a, bool inputs_vary, std::vector<std::string>& said) {
  if (!a.lie || a.lie->space.nullity == a.local.space.nullity) return;
  said.push_back("The Lie derivatives have nullity " + std::to_string(a.lie->space.nullity) +
                 ", this motion " + std::to_string(a.local.space.nullity) + ": " +
                 cause_of_lie(a, inputs_vary));
}

/// The same rows, weighted by the measurement noise.
void compare_with_information(const ObservabilityAnalysis& a, std::vector<std::string>& said) {
  const int local = a.local.space.nullity, weighed = a.fisher.space.nullity;
  if (local == weighed) return;
  said.push_back(
      "The Fisher information has nullity " + std::to_string(weighed) + ", the motion " +
      std::to_string(local) + ": " +
      (both_clear(a.fisher.space, a.local.space)
           ? "the information weights each measurement with its sensitivity over its sigma, and these weights differ so much that some are below rounding. The rank of the motion scales all measurements alike."
           : not_clear));
}

/// The same segments without error coordinates: the rank of SOM depends on the coordinates.
void compare_coordinates(const ObservabilityAnalysis& a, const SystemInstance& instance,
                         const SystemMotion& motion, const NullSpaceSettings& rank,
                         std::vector<std::string>& said) {
  if (!instance.has_error_form()) return;
  std::vector<LinearizedSystem> exact;
  for (const MotionSegment& s : motion.segments) exact.push_back(instance.linearize(s.start));
  std::string stated, plain;
  bool all_alike = true;
  const auto upto = stripped_observability(segment_observability(exact));
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const int here = null_space(upto[k], rank).nullity, there = a.segments[k].stripped.space.nullity;
    all_alike = all_alike && here == there;
    stated += (k > 0 ? "/" : "") + std::to_string(there);
    plain += (k > 0 ? "/" : "") + std::to_string(here);
  }
  if (!all_alike)
    said.push_back("SOM has nullity " + stated + " in the stated error form and " + plain +
                   " in plain derivatives of the same equations: its rank depends on the coordinates.");
}

}  // namespace

std::vector<std::string> disagreements_in(const ObservabilityAnalysis& a, const SystemInstance& instance,
                                          const SystemMotion& motion,
                                          const std::vector<MotionSample>& samples,
                                          const NullSpaceSettings& rank) {
  std::vector<std::string> said;
  compare_with_motion(a, form_changes(instance, samples), said);
  compare_som_and_tom(a, said);
  const auto& others = motion.other_inputs;
  compare_with_lie(
      a,
      std::any_of(others.begin(), others.end(),
                  [&](const Eigen::VectorXd& u) { return u != motion.segments.front().start.u; }),
      said);
  compare_with_information(a, said);
  compare_coordinates(a, instance, motion, rank, said);
  return said;
}

namespace {

std::string short_number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Reason why a rank is ambiguous.
std::string why_not_clear(const NullSpace& space, const std::vector<std::string>& states) {
  std::string faint;
  for (std::size_t i = 0; i < space.faint.size(); ++i)
    if (space.faint[i]) faint += (faint.empty() ? "" : ", ") + states[i];
  if (!faint.empty())
    return "the effect of " + faint +
           " on the measurements is below rounding relative to the others, and is omitted";
  const std::string least = "the smallest singular value above the tolerance is " +
                            short_number("%.2g", space.least) + " of the largest";
  return std::isinf(space.gap) ? least + ", close to the tolerance"
                               : least + ", " + short_number("%.2g", space.gap) + " times the next";
}

void doubt_ranks(const ObservabilityAnalysis& a, std::vector<std::string>& doubts) {
  const auto check_rank = [&](const std::string& what, const NullSpace& space,
                              const std::vector<std::string>& states) {
    if (space.ambiguous)
      doubts.push_back("The rank of " + what + " is ambiguous, probably " + std::to_string(space.rank) +
                       ": " + why_not_clear(space, states) + ".");
  };
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    check_rank("SOM after segment " + std::to_string(k + 1), a.segments[k].stripped.space, a.error_states);
    check_rank("TOM after segment " + std::to_string(k + 1), a.segments[k].total.space, a.error_states);
  }
  check_rank("the local matrix", a.local.space, a.states);
  check_rank("the Fisher information", a.fisher.space, a.states);
  if (a.lie) check_rank("the Lie derivatives", a.lie->space, a.states);
}

void doubt_lie(const LieAnalysis& lie, std::vector<std::string>& doubts) {
  if (lie.missed)
    doubts.push_back(
        "Lie derivatives with a negligible contribution were not differentiated further; badly scaled states or units may hide a contribution.");
  else if (!lie.closed)
    doubts.push_back("The Lie derivatives were computed up to order " + std::to_string(lie.orders_examined) +
                     "; higher orders (--lie-order) may raise the rank.");
  if (lie.space.rank < lie.generic_rank)
    doubts.push_back("The Lie derivatives have rank " + std::to_string(lie.space.rank) +
                     " at the start of this motion and " + std::to_string(lie.generic_rank) +
                     " at other states with the same inputs.");
}

/// An observable state may still be too weakly observable to be useful.
void note_weakly_observable(const ObservabilityAnalysis& a, std::vector<std::string>& notes) {
  constexpr int most = 6;
  int count = 0;
  for (const StateInformation& i : a.information) {
    if (!i.weakly_observable || ++count > most) continue;
    notes.push_back(i.state + " is only weakly observable: sigma " + short_number("%.2g", *i.sigma) +
                    ", width of its region " + short_number("%.3g", i.region_width) + ".");
  }
  if (count > most)
    notes.push_back(counted(count - most, "further state is", "further states are") +
                    " only weakly observable.");
}

void note_inputs(const SymbolicSystem& s, std::vector<std::string>& notes) {
  std::vector<SymbolicSystem::Slot> used;
  for (const auto* block : {&s.vehicle, &s.landmark, &s.anchor}) {
    used.insert(used.end(), block->rates.begin(), block->rates.end());
    used.insert(used.end(), block->measurements.begin(), block->measurements.end());
    for (const auto* entries : {&block->error_F, &block->error_H})
      for (const SymbolicSystem::Entry& entry : *entries) used.push_back(entry.value);
  }
  for (const auto& assignment : s.assignments) used.push_back(assignment.value);
  const std::vector<bool> needed = s.graph.needed_for(used);
  for (const SymbolicSystem::Slot input : s.inputs)
    if (!needed[static_cast<std::size_t>(input)])
      notes.push_back("Input `" + s.graph[input].name + "` occurs in no equation and no measurement.");
}

}  // namespace

std::vector<std::string> doubts_in(const ObservabilityAnalysis& a) {
  std::vector<std::string> doubts;
  doubt_ranks(a, doubts);
  if (a.growth > most_growth)
    doubts.push_back("Small differences grow by a factor of " + short_number("%.2g", a.growth) +
                     " along the motion, so that its results are unreliable; reduce segment_duration_s.");
  if (a.lie) doubt_lie(*a.lie, doubts);
  return doubts;
}

std::vector<std::string> notes_on(const ObservabilityAnalysis& a, const SymbolicSystem& system) {
  std::vector<std::string> notes;
  if (a.growth <= most_growth) note_weakly_observable(a, notes);
  note_inputs(system, notes);
  return notes;
}

}  // namespace incognita
