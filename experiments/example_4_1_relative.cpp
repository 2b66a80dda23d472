// Example 4.1, relative map: features relative to the vehicle, in axes of the world, and its heading.
//
// Experiment: the built-in system `planar` in its relative form, motions and rules of
// observability_claims.hpp; 1 to 3 features; also straight on, with the feature straight ahead or abeam (the
// vehicle then heads along x, as r_y = 0 and r_x = 0 mean), and at rest, turning or not. The thesis says r =
// x_f - p and prints matrices of p - x_f; ours is x_f - p. Null spaces without a heading are the same.
#include <set>

#include "experiments/common.hpp"
#include "experiments/example_4_1.hpp"

namespace incognita::observability_claims::planar {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

const Study& relative(int features = 1, const std::string& motion = "general", const Change& change = {}) {
  return study({.system = "planar",
                .representation = "relative",
                .features = features,
                .motion = motion,
                .change = change});
}

Vector2d r_to(const SystemPoint& point, int feature) { return point.x.segment<2>(1 + 2 * feature); }

/// Heading first, as our states are; the printed ones have it last.
VectorXd three(double rx, double ry, double theta) { return Eigen::Vector3d(theta, rx, ry); }

/// The feature so far ahead and aside of a vehicle that heads along x, driving straight on.
const Study& beside(const std::string& name, NamedRange ahead, NamedRange aside) {
  const auto place = [=](SystemText& text) {
    text.vehicle.region[0].low = text.vehicle.region[0].high = 0;
    auto& region = text.landmark->region;
    region[0].low = ahead.low, region[0].high = ahead.high;
    region[1].low = aside.low, region[1].high = aside.high;
  };
  return relative(1, "straight", {name, place});
}

const Study& straight_ahead() { return beside("ahead", {"", {}, 5, 9}, {"", {}, 0, 0}); }
const Study& abeam() { return beside("abeam", {"", {}, 0, 0}, {"", {}, 3, 9}); }

/// The distance of each feature.
Basis distances(const Course& course, int features) {
  Basis all;
  for (int i = 0; i < features; ++i) {
    VectorXd v = VectorXd::Zero(1 + 2 * features);
    v.segment<2>(1 + 2 * i) = r_to(course.points[0], i);
    all.push_back(v);
  }
  return all;
}

/// Heading and features turned.
VectorXd turned(const Course& course, int features) {
  VectorXd v = VectorXd::Zero(1 + 2 * features);
  v[0] = 1;
  for (int i = 0; i < features; ++i) {
    const Vector2d r = r_to(course.points[0], i);
    v.segment<2>(1 + 2 * i) << -r.y(), r.x();
  }
  return v;
}

/// Whether the motion itself leaves the turn and nothing else.
bool leaves_the_turn(const Study& s, int features) {
  return s.along_spanned_by([&](const Course& c) { return Basis{turned(c, features)}; });
}

/// Whether, with the feature straight ahead, the motion itself leaves its distance and the turn.
bool leaves_distance_and_turn(const Study& s) {
  return s.along_spanned_by([](const Course& c) { return Basis{three(1, 0, 0), turned(c, 1)}; });
}

/// `1: 1/0/0 and 1; 2: 2/0/0 and 1`
std::string by_features() {
  const Cases all =
      by_number({1, 2, 3}, [](int features) { return CaseResult{relative(features).numbers()}; });
  return fmt::format("{}, by features: {}", legend, all.text());
}

Claim measurement_matrix() {
  Worst worst;
  for (const Course& course : relative(3).courses())
    for (const int feature : {0, 2}) {  // the rows that are printed, in the printed order: heading last
      VectorXd exact(7), as_printed = VectorXd::Zero(7), ours = as_printed;
      exact << course.exact[0].H.row(feature).tail(6).transpose(), course.exact[0].H(feature, 0);
      const Vector2d r = r_to(course.points[0], feature);
      as_printed.segment<2>(2 * feature) << r.y() / r.squaredNorm(), -r.x() / r.squaredNorm();
      ours = -as_printed;
      as_printed[2] = ours[6] = -1;
      worst.take(as_printed, ours, exact);
    }
  return studied("4.1-relative-H", "(4.23), (4.24)",
                 "H of features parametrized by r = x_f - p is the derivative of (4.12), to 1e-9",
                 {.printed = "[r_y -r_x]/d^2, -1 in the third column",
                  .measured = fmt::format("largest difference in {} motions: {}", motions, worst.text()),
                  .why = "[-r_y r_x]/d^2 for r = x_f - p (what is printed belongs to p - x_f), and -1 in the "
                         "last column, the heading's"},
                 worst, rounding);
}

Claim instant_null_space() {
  bool basis = true;
  std::vector<int> found;
  for (const int features : {1, 2, 3}) {
    const Study& s = relative(features);
    found.push_back(dimension(s.stripped(1)));
    basis = basis && s.stripped_spanned_by(1, [&](const Course& c) { return distances(c, features); });
  }
  return studied(
      "4.1-relative-null-space", "(4.25)", "Null space of one segment: the distance of each feature",
      {.printed = "one vector for each",
       .measured =
           fmt::format("dimension with 1/2/3 features in {} motions {}; the printed vectors span it: {}",
                       motions, joined(found), yes_no(basis)),
       .runs = 3 * motions},
      basis);
}

Claim orientation() {
  const std::vector<std::string> heading{"theta"};
  std::vector<std::string> in_segment, along;
  bool printed = true, turns = true;
  for (const int features : {1, 2, 3}) {
    const Study& s = relative(features);
    in_segment.push_back(listed(observable_states(s.stripped(1), s.error_states())));
    along.push_back(listed(observable_states(s.along(), s.states())));
    printed = printed && in_segment.back() == "theta" && along.back() == "theta";
    turns = turns && leaves_the_turn(s, features);
  }
  return studied("4.1-relative-orientation", "below (4.25)",
                 "The orientation is the one state that is observable in one segment, however many features",
                 {.printed = "orientation",
                  .measured = fmt::format("states outside the null space with 1/2/3 features: of Q_1 {}; of "
                                          "the motion itself {}, which leaves the turn of all: {}",
                                          fmt::join(in_segment, "/"), fmt::join(along, "/"), yes_no(turns)),
                  .why = "so it is by Q_1. The text itself doubts it (footnote 2): turning the vehicle and r "
                         "of all features changes no measurement",
                  .runs = 3 * motions},
                 printed);
}

Claim footnote() {
  const Spaces spaces = lie({.system = "planar", .representation = "relative"});
  const Study& s = relative();
  const bool turn_alone = are_basis(spaces, s.courses(), [](const Course& c) { return Basis{turned(c, 1)}; });
  return studied(
      "4.1-footnote-2", "footnote 2",
      "By Lie derivatives the orientation with respect to a global frame is not observable for the relative "
      "map",
      {.printed = "not observable",
       .measured = fmt::format(
           "Lie derivatives leave {} at {} points, the motion itself {}: heading and map turned, {}",
           joined({dimension(spaces)}), motions, joined({s.true_dimension()}),
           turn_alone && leaves_the_turn(s, 1) ? "both" : "not both")},
      turn_alone && leaves_the_turn(s, 1));
}

Claim ahead_instant() {
  const Study& s = straight_ahead();
  const bool basis = s.stripped_spanned_by(1, [](const Course&) { return Basis{three(1, 0, 0)}; });
  return studied("4.1-ahead", "below (4.25)",
                 "With the feature straight ahead (r_y = 0) the unobservable mode of Q_1 is r_x",
                 {.printed = "r_x",
                  .measured = fmt::format("dimension {} in {} motions; it is r_x: {}",
                                          dimension(s.stripped(1)), motions, yes_no(basis))},
                 basis);
}

Claim abeam_instant() {
  const Study& s = abeam();
  const auto mode = [](const Course&) { return Basis{three(0, 1, 0)}; };
  const auto both = [](const Course& c) {
    return Basis{three(0, 1, 0), three(-r_to(c.points[0], 0).y(), 0, 1)};
  };
  return studied(
      "4.1-abeam", "below (4.25)", "With the feature abeam (r_x = 0) the unobservable mode of Q_1 is r_y",
      {.printed = "r_y",
       .measured = fmt::format("dimension {} in {} motions", dimension(s.stripped(1)), motions),
       .why = "r_y, and the heading together with r_x: the row H F is zero abeam, so that Q_1 is but H"},
      s.stripped_spanned_by(1, mode), s.stripped_spanned_by(1, both));
}

Claim two_segments() {
  bool full = true;
  for (const int features : {1, 2, 3}) full = full && relative(features).full_rank(2);
  return studied("4.1-relative-two-segments", "below (4.25)", "SOM and TOM have full rank in two segments",
                 {.printed = "0", .measured = by_features(), .runs = 3 * motions}, full);
}

Claim fully_observable() {
  bool printed = true, turns = true, by_matrices = true;
  for (const int features : {1, 2, 3}) {
    const Study& s = relative(features);
    printed = printed && s.true_dimension() == 0;
    turns = turns && leaves_the_turn(s, features);
    by_matrices = by_matrices && s.full_rank(2);
  }
  return studied("4.1-relative-observable", "below (4.25), Section 4.4",
                 "Opposite to the world-centric map this system becomes fully observable in two segments",
                 {.printed = "fully",
                  .measured = fmt::format("{}. What is left is heading and map turned: {}", by_features(),
                                          turns ? "always" : "not always"),
                  .why = "up to the orientation of the axes: the map in the vehicle's frame becomes "
                         "observable, the direction of north does not, with any number of features. SOM and "
                         "TOM have full rank because H is frozen",
                  .runs = 3 * motions},
                 printed && by_matrices, turns && by_matrices);
}

Claim ahead_for_good() {
  const Study& s = straight_ahead();
  bool mode = true;
  for (int k = 1; k <= 3; ++k)
    mode = mode && s.stripped_spanned_by(k, [](const Course&) { return Basis{three(1, 0, 0)}; });
  const bool along = leaves_distance_and_turn(s);
  return studied("4.1-ahead-for-good", "below (4.25)",
                 "Driving straight at a feature the system remains unobservable, with mode r_x",
                 {.printed = "r_x",
                  .measured = fmt::format(
                      "{}, in {} motions. SOM leaves r_x: {}; the motion itself r_x and the turn of all: {}",
                      s.text(), motions, yes_no(mode), yes_no(along))},
                 mode && along);
}

Claim abeam_for_good() {
  const Study& s = abeam();
  return studied(
      "4.1-abeam-two-segments", "below (4.25)",
      "With the feature abeam at first SOM and TOM have full rank in two segments",
      {.printed = "0", .measured = fmt::format("{}, in {} motions straight on", s.text(), motions)},
      s.full_rank(2));
}

Claim pure_rotation() {
  const Change turning{"turning", [](SystemText& text) {
                         for (MotionText& motion : text.motions)
                           std::erase_if(motion.assignments,
                                         [](const NamedExpression& a) { return a.name == "omega"; });
                       }};
  std::vector<std::string> lines;
  std::set<std::string> seen;
  bool all = true;
  for (const Change& change : {Change{}, turning})
    for (const int features : {1, 2, 3}) {
      const Study& s = relative(features, "stationary", change);
      const std::vector<int> one_more(3, features + 1);
      all = all && s.dimensions() == one_more && s.total_dimensions() == one_more &&
            s.true_dimension() == features + 1;
      for (const auto& states :
           {observable_states(s.stripped(3), s.error_states()), observable_states(s.along(), s.states())})
        seen.insert(states.begin(), states.end());
      lines.push_back(fmt::format("{}{}: {}", features, change.apply ? ", turning" : "", s.numbers()));
    }
  return studied("4.1-pure-rotation", "below (4.25), Section 4.4",
                 "Without translation the null space has one vector more, SOM and TOM never have full rank, "
                 "and neither position nor orientation is recovered",
                 {.printed = "one more than features",
                  .measured = fmt::format("{}, by features: {}; states outside the null spaces: {}", legend,
                                          fmt::join(lines, "; "), listed({seen.begin(), seen.end()})),
                  .runs = 6 * motions},
                 all && seen.empty());
}

Claim no_rotation() {
  const Study &s = relative(1, "straight"), &ahead = straight_ahead();
  const bool as_matrices = dimension(s.stripped(2)) == 0 && dimension(ahead.stripped(3)) > 0;
  return studied("4.1-no-rotation", "end of the relative map, Example 4.1",
                 "Without rotation the system is completely observable in two segments, except with a "
                 "feature on the line of sight",
                 {.printed = "completely",
                  .measured = fmt::format("{}: {}; straight ahead: {}", legend, s.numbers(), ahead.numbers()),
                  .why = "up to the axes, as with rotation; on the line of sight the distance is missing too",
                  .runs = 2 * motions},
                 as_matrices && s.true_dimension() == 0,
                 as_matrices && leaves_the_turn(s, 1) && leaves_distance_and_turn(ahead));
}

}  // namespace

std::vector<Claim> relative_claims() {
  return {measurement_matrix(), instant_null_space(), orientation(),   footnote(),
          ahead_instant(),      abeam_instant(),      two_segments(),  fully_observable(),
          ahead_for_good(),     abeam_for_good(),     pure_rotation(), no_rotation()};
}

}  // namespace incognita::observability_claims::planar
