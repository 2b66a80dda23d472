// What the claims of Chapter 4 rest on: systems of systems/*.toml in 20 motions each, the matrices (4.6) to
// (4.8), the observability along the motion itself, and printed vectors compared with their null spaces.
//
// Motions: three segments of 1 s (in space 0.25 s), unless said otherwise; start, inputs and what disturbs
// the system drawn from its regions as `incognita observe` draws them with seeds 1 to 20. No noise. A
// dimension holds when it is the same in all motions, by singular values above 1e-9 of the largest and a
// factor of 1000 clear of the others. A printed null space holds when its vectors lie in the computed one (to
// 1e-9), are independent and as many as its dimension. A state is observable when no vector of the null space
// touches it.
//
// A claim about the matrices themselves - F, H, Q_1, SOM, TOM, what spans their null spaces - has one finding.
// A claim about a system or its states - observable, recovered, a number of modes - has two:
// - in truth (InTruth, Claim::finding): by the motion itself, that is by the local observability matrix along
//   it, with exact derivatives and with unknown disturbances taken out. Lie derivatives agree with it
//   (text-4-piecewise). `In one segment` is a motion of one segment, measured all along.
// - by the method of the thesis (ByMethod, Claim::by_method): by the null spaces of SOM and TOM with F and H
//   of the system's error form where each segment begins, frozen until its end; in one segment by Q_1.
// They differ because H F is not how H changes when F moves the vehicle: seen_by_frozen_rows_only().
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cases.hpp"
#include "experiments/two_findings.hpp"
#include "experiments/worst.hpp"
#include "incognita/analysis/observability/null_space.hpp"
#include "incognita/analysis/systems/linearization.hpp"
#include "incognita/analysis/systems/system_instance.hpp"
#include "incognita/analysis/systems/system_text.hpp"

namespace incognita::observability_claims {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd;

inline constexpr int motions = 20;

/// Largest difference of entries of matrices that count as equal.
inline constexpr double rounding = 1e-9;

/// A change of a built-in system; its name identifies the study.
struct Change {
  std::string name;
  std::function<void(SystemText&)> apply;
};

/// The motion `stationary`, but for turning.
Change turning();
/// The vehicle at the origin, heading along x, and the feature so far ahead and to the left (low, high).
Change feature_within(const std::string& name, const Vector2d& ahead, const Vector2d& left);

struct Case {
  std::string system;
  std::string representation = "world";
  int features = 1;
  int anchors = 0;
  std::string motion = "general";
  Change change = {};
  int segments = 3;
  double segment_s = 0;  ///< 0: 1 s, in space `in_space_s`
};

/// The map relative to the vehicle, of so many features.
inline Case relative_map(const std::string& system, int features = 1, const std::string& motion = "general") {
  return {.system = system, .representation = "relative", .features = features, .motion = motion};
}

/// Length of a segment of the systems in space, which take longer to follow.
inline constexpr double in_space_s = 0.25;

/// One motion: where each segment begins, F and H there in the system's error form, and by exact derivatives.
struct Course {
  std::vector<SystemPoint> points;
  std::vector<LinearizedSystem> forms, exact;
  bool stays = false;                      ///< (4.9) holds in each segment
  std::vector<NamedDirection> directions;  ///< that the system's file names, by the states where it begins
};

using Spaces = std::vector<NullSpace>;  ///< of each motion

using Basis = std::vector<VectorXd>;
/// Vectors that a claim is about, in one motion.
using Vectors = std::function<Basis(const Course&)>;

/// The same in all motions.
Vectors always(const Basis& vectors);
/// The directions of the system's file that begin with these names: `rotation`, `depth` (of each feature).
Vectors named(const std::vector<std::string>& names);
/// `rotation`, `rotation about z` or `scale`, about the first anchor in place of the origin.
Vectors about_anchor(const std::vector<std::string>& names);

/// One case in all its motions.
class Study {
 public:
  explicit Study(Case which);

  const Case& which() const { return which_; }
  const std::vector<Course>& courses() const { return courses_; }
  const std::vector<std::string>& states() const { return states_; }
  const std::vector<std::string>& error_states() const { return error_states_; }
  /// Of the first k segments together: (4.8) and (4.7).
  const Spaces& stripped(int k) const { return stripped_[static_cast<std::size_t>(k - 1)]; }
  const Spaces& total(int k) const { return total_[static_cast<std::size_t>(k - 1)]; }
  /// Dimension of the SOM's null space; states outside it.
  int left(int k) const;
  std::vector<std::string> observable(int k) const;
  /// Of all measurements along the motion, by the states at its start and exact derivatives. Computed on
  /// demand.
  const Spaces& along() const;
  int true_dimension() const;
  std::vector<std::string> observable_along() const;

  /// Dimensions of the SOM's null spaces, one for each number of segments; no_dimension where there is none.
  std::vector<int> dimensions() const;
  std::vector<int> total_dimensions() const;
  bool stays() const;  ///< (4.9), everywhere
  /// Whether SOM and TOM of the first k segments have one null space.
  bool same_spaces(int k) const;
  /// Whether SOM and TOM of the first k segments have full rank; whether neither has.
  bool full_rank(int k) const;
  bool rank_deficient(int k) const;
  /// Whether the vectors span the null space of the SOM of the first k segments.
  bool stripped_spanned_by(int k, const Vectors& vectors) const;
  /// Whether they span the null space of the motion itself; whether they lie in it.
  bool along_spanned_by(const Vectors& vectors) const;
  bool along_contains(const Vectors& vectors) const;
  /// `3/2/2`: what SOM leaves, and TOM where that is something else
  std::string segments_text() const;
  /// `SOM and TOM leave 3/2/2 dimensions after 1/2/3 segments, the motion itself 3`
  std::string text() const;
  /// `3/2/2 and 3`: the same, explained by `legend`
  std::string numbers() const;

 private:
  Case which_;
  std::vector<Course> courses_;
  std::vector<std::string> states_, error_states_;
  std::vector<Spaces> stripped_, total_;
  mutable Spaces along_;
};

/// Of numbers().
inline constexpr char legend[] =
    "dimensions left by SOM and TOM after 1/2/3 segments, and by the motion itself";

/// Studies beside each other.
class Studies {
 public:
  explicit Studies(const std::string& what = "");
  const Study& add(const std::string& name, const Study& one);
  std::string text() const;  ///< `LEGEND, WHAT: planar 3/2/2 and 3; ...`
  int cases() const { return static_cast<int>(all_.size()); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }
  bool all(const std::function<bool(const Study&)>& hold) const;
  std::vector<int> each(const std::function<int(const Study&)>& of) const;

 private:
  std::string head_;
  std::vector<std::string> lines_;
  std::vector<std::reference_wrapper<const Study>> all_;
};

/// Of a case with each number of features or anchors: `LEGEND, by features: 1: 3/2/2 and 3; ...`
Studies by_features(std::initializer_list<int> numbers, Case which);
Studies by_anchors(std::initializer_list<int> numbers, Case which);

// In truth:
inline bool fully_observable(const Study& s) { return s.true_dimension() == 0; }
inline bool partially_observable(const Study& s) { return s.true_dimension() > 0; }
// By the method:
inline bool full_in_two(const Study& s) { return s.full_rank(2); }
inline bool never_full(const Study& s) { return s.rank_deficient(3); }

/// Whether it holds for each of the numbers, for example of segments or features.
inline bool for_all(std::initializer_list<int> numbers, const std::function<bool(int)>& holds) {
  return std::ranges::all_of(numbers, holds);
}
std::vector<int> each_of(std::initializer_list<int> numbers, const std::function<int(int)>& of);

/// The claim by assessed(), over all motions of `cases` cases: of matrices with what it found of them, of a
/// system with InTruth and ByMethod.
template <class... Findings>
Claim studied(int cases, std::string id, std::string place, std::string statement, Evidence evidence,
              const Findings&... findings) {
  evidence.runs = cases * motions;
  return assessed(std::move(id), std::move(place), std::move(statement), std::move(evidence), findings...);
}
template <class... Findings>
Claim studied(std::string id, std::string place, std::string statement, Evidence evidence,
              const Findings&... findings) {
  return studied(1, std::move(id), std::move(place), std::move(statement), std::move(evidence), findings...);
}

/// The number of a claim that a dimension decides; none when it is not the same in all motions.
std::optional<ClaimNumber> number_of(std::string what, int dimension);
/// `dimensions left by the motion itself`, with what is added.
std::optional<ClaimNumber> left_in_truth(const Study& study, const std::string& added = "");

/// Each case is studied once.
const Study& study(const Case& which);

/// Null spaces of the Lie derivatives where the first motions begin. Throws std::runtime_error when an
/// order's limit was hit.
Spaces lie(const Case& which, int how_many = motions);

inline constexpr int no_dimension = -1;

/// Of all the spaces, if they agree and none is in doubt.
int dimension(const Spaces& spaces);
/// Null spaces of a matrix in each motion of a study.
Spaces null_spaces(const Study& study, const std::function<MatrixXd(const Course&)>& matrix);
/// `3/2/2`
std::string joined(const std::vector<int>& dimensions);

/// Whether every vector lies in its motion's space.
bool contain(const Spaces& spaces, const std::vector<Course>& courses, const Vectors& vectors);
/// Whether the vectors lie in it, are independent, and as many as it has dimensions.
bool are_basis(const Spaces& spaces, const std::vector<Course>& courses, const Vectors& vectors);
/// How many dimensions the vectors span, if it is as many in all motions.
int span(const std::vector<Course>& courses, const Vectors& vectors);
/// In how many dimensions the spaces move some states, so many from the first on, if it is as many in all.
int dimension_within(const Spaces& spaces, Eigen::Index first, Eigen::Index count);
/// Whether two spaces are one.
bool same(const Spaces& a, const Spaces& b);

/// States that are zero in all vectors of all spaces; with a question mark where some motions' do.
std::vector<std::string> observable_states(const Spaces& spaces, const std::vector<std::string>& states);

/// Whether each vector changes no measurement, neither the first nor those along the motion, but H F, in which
/// H is frozen while F moves the vehicle: then SOM and TOM have too high a rank for that reason.
bool seen_by_frozen_rows_only(const Study& study, const Vectors& vectors);

/// (4.8) of the first k segments when F and H are not the system's.
Spaces stripped_with(const Study& study, int k,
                     const std::function<void(LinearizedSystem&, const SystemPoint&)>& change);

/// Largest entry of a difference.
inline double apart(const MatrixXd& a, const MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); }
/// Largest of a number over all motions.
double largest(const Study& study, const std::function<double(const Course&)>& of);

/// `x and y`, `none`
std::string listed(const std::vector<std::string>& names);

// Parts of entries, in files of their own.

/// Section 4.1: Gramian, SOM and TOM, what the method can show.
std::vector<Claim> method_claims();

/// Section 4.3, Abstract and conclusions: what a filter learns, by the motions that null spaces tell.
std::vector<Claim> filter_claims(int seeds);

/// Example 4.3: the relative map.
std::vector<Claim> planar_cv_relative_claims();

}  // namespace incognita::observability_claims
