#include "incognita/analysis/explain_observability.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "incognita/analysis/observability_matrices.hpp"

namespace incognita {
namespace {

/// Keeps what adds a dimension to what it holds, in coordinates where all columns weigh alike.
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

/// Combinations of directions of the whole that lie in the space, such as a rotation about an anchor: one
/// about the origin and a shift. The last that are named lead.
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
  NoisyRows rows{outside, Eigen::VectorXd::Zero(n), true};
  std::vector<NamedDirection> found;
  for (const Eigen::VectorXd& c : readable_basis(null_space(rows).basis)) {
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
  for (const Eigen::VectorXd& v : readable_basis(space.basis)) take(written_combination(v, states), v);
  return directions;
}

SeenSpace seen_space(const NoisyRows& rows, const std::vector<NamedDirection>& named,
                     const std::vector<std::string>& states, const NullSpaceSettings& settings) {
  SeenSpace seen{null_space(rows, settings), {}};
  seen.directions = named_directions(seen.space, named, states);
  return seen;
}

namespace {

/// The SOM against the motion itself: it freezes H while F moves the vehicle on.
void compare_with_motion(const ObservabilityAnalysis& a, std::vector<std::string>& said) {
  const int local = a.local.space.nullity, frozen = a.segments.back().stripped.space.nullity;
  if (local == frozen) return;
  const std::string k = counted(static_cast<int>(a.segments.size()), "segment", "segments");
  if (frozen < local) {
    said.push_back(
        "SOM over " + k + " leaves " + std::to_string(frozen) + " unobservable, the motion itself " +
        std::to_string(local) + " (" + list_of(a.local.directions) +
        "): inside a segment H stays frozen while F moves the vehicle on, and what does not change a "
        "single look seems to. A filter that linearises anew at each estimate believes the same.");
  } else {
    said.push_back("SOM over " + k + " leaves " + std::to_string(frozen) + " unobservable (" +
                   list_of(a.segments.back().stripped.directions) + "), the motion itself " +
                   std::to_string(local) +
                   ": the change of H within a segment, which SOM drops, is what shows "
                   "the rest.");
  }
}

void compare_som_and_tom(const ObservabilityAnalysis& a, std::vector<std::string>& said) {
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    const SegmentAnalysis& s = a.segments[k];
    if (s.stripped.space.nullity == s.total.space.nullity) continue;
    said.push_back("After segment " + std::to_string(k + 1) + " SOM leaves " +
                   std::to_string(s.stripped.space.nullity) + " unobservable and TOM " +
                   std::to_string(s.total.space.nullity) + ": condition (4.9) " +
                   (s.condition_holds ? "holds for each segment, so that one of the ranks is wrong"
                                      : "does not hold, so that SOM may not stand for TOM") +
                   ".");
  }
}

void compare_with_lie(const ObservabilityAnalysis& a, std::vector<std::string>& said) {
  if (!a.lie || a.lie->space.nullity == a.local.space.nullity) return;
  const int lie = a.lie->space.nullity, local = a.local.space.nullity;
  said.push_back("Lie derivatives leave " + std::to_string(lie) + " unobservable, this motion " +
                 std::to_string(local) + ": " +
                 (lie < local     ? "other inputs of this kind than the ones held here would show more."
                  : a.lie->closed ? "the motion leaves its starting point, at which the Lie derivatives are "
                                    "taken, and sees more from elsewhere."
                                  : "the order of the Lie derivatives was limited."));
}

/// The same rows, weighed with the noises.
void compare_with_information(const ObservabilityAnalysis& a, std::vector<std::string>& said) {
  const int local = a.local.space.nullity, weighed = a.fisher.space.nullity;
  if (local == weighed) return;
  said.push_back("The Fisher information leaves " + std::to_string(weighed) + " unobservable, the motion " +
                 std::to_string(local) +
                 ": the measurements' sigmas differ so much that beside the best of them the "
                 "others count as nothing.");
}

/// The same segments in plain differences of the states: SOM's rank depends on coordinates.
void compare_coordinates(const ObservabilityAnalysis& a, const SystemInstance& instance,
                         const SystemMotion& motion, const NullSpaceSettings& rank,
                         std::vector<std::string>& said) {
  if (!instance.has_error_form()) return;
  std::vector<Linearisation> exact;
  for (const MotionSegment& s : motion.segments) exact.push_back(instance.linearise(s.start));
  std::string stated, plain;
  bool differ = false;
  for (int k = 1; k <= static_cast<int>(exact.size()); ++k) {
    const int here = null_space(stripped_observability(exact, k), rank).nullity;
    const int there = a.segments[static_cast<std::size_t>(k - 1)].stripped.space.nullity;
    differ = differ || here != there;
    stated += (k > 1 ? "/" : "") + std::to_string(there);
    plain += (k > 1 ? "/" : "") + std::to_string(here);
  }
  if (differ)
    said.push_back("SOM in the stated error form leaves " + stated +
                   " unobservable, in plain derivatives of the "
                   "same equations " +
                   plain + ": what it finds depends on the coordinates.");
}

}  // namespace

std::vector<std::string> disagreements_in(const ObservabilityAnalysis& a, const SystemInstance& instance,
                                          const SystemMotion& motion, const NullSpaceSettings& rank) {
  std::vector<std::string> said;
  compare_with_motion(a, said);
  compare_som_and_tom(a, said);
  compare_with_lie(a, said);
  compare_with_information(a, said);
  compare_coordinates(a, instance, motion, rank, said);
  return said;
}

std::vector<std::string> doubts_in(const ObservabilityAnalysis& a) {
  std::vector<std::string> doubts;
  const auto look = [&](const std::string& what, const NullSpace& space) {
    if (!space.ambiguous) return;
    char gap[32];
    std::snprintf(gap, sizeof gap, "%.2g", space.gap);
    doubts.push_back("The rank of " + what + " is not clear: " + std::to_string(space.rank) +
                     " is the best guess, but the singular values around it differ by a factor of only " +
                     gap + ".");
  };
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    look("SOM after segment " + std::to_string(k + 1), a.segments[k].stripped.space);
    look("TOM after segment " + std::to_string(k + 1), a.segments[k].total.space);
  }
  look("the local matrix", a.local.space);
  look("the Fisher information", a.fisher.space);
  if (a.growth > 1e8) {
    char growth[32];
    std::snprintf(growth, sizeof growth, "%.2g", a.growth);
    doubts.push_back(
        std::string("Small differences grow by a factor of ") + growth +
        " along the motion: what is said of it is not to be trusted; a shorter segment_duration_s helps.");
  }
  if (!a.lie) return doubts;
  look("the Lie derivatives", a.lie->space);
  if (!a.lie->closed)
    doubts.push_back("The Lie derivatives were followed to order " + std::to_string(a.lie->orders_examined) +
                     " only; higher ones (--lie-order) might show more.");
  if (a.lie->space.rank < a.lie->generic_rank)
    doubts.push_back("The Lie derivatives have rank " + std::to_string(a.lie->space.rank) +
                     " where this motion starts and " + std::to_string(a.lie->generic_rank) +
                     " at other states with the same inputs.");
  return doubts;
}

}  // namespace incognita
