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

const Study& relative(int features = 1, const std::string& motion = "general", const Change& change = {}) {
  Case which = relative_map("planar", features, motion);
  which.change = change;
  return study(which);
}

Vector2d r_to(const SystemPoint& point, int feature) { return point.x.segment<2>(1 + 2 * feature); }

/// Heading first, as our states are; the printed ones have it last.
VectorXd three(double rx, double ry, double theta) { return Vector3d(theta, rx, ry); }

/// Driving straight on, with the feature straight ahead or abeam.
const Study& straight_ahead() { return relative(1, "straight", feature_within("ahead", {5, 9}, {0, 0})); }
const Study& abeam() { return relative(1, "straight", feature_within("abeam", {0, 0}, {3, 9})); }

bool leaves_the_turn(const Study& s) { return s.along_spanned_by(named({"rotation"})); }

bool leaves_distance_and_turn(const Study& s) { return s.along_spanned_by(named({"depth", "rotation"})); }

const Vectors r_x = always({three(1, 0, 0)});

Studies maps_of_three() { return by_features({1, 2, 3}, relative_map("planar")); }

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
                  .measured = {"largest difference in {} motions: {}", motions, worst.text()},
                  .why = "[-r_y r_x]/d^2 for r = x_f - p (what is printed belongs to p - x_f), and -1 in the "
                         "last column, the heading's"},
                 worst, rounding);
}

std::vector<Claim> one_segment() {
  const Studies maps = maps_of_three();
  const auto found = maps.each([](const Study& s) { return s.left(1); });
  const bool basis = maps.all([](const Study& s) { return s.stripped_spanned_by(1, named({"depth"})); });
  std::vector<std::string> in_segment, along;
  for (const Study& s : maps) {
    in_segment.push_back(listed(s.observable(1)));
    along.push_back(listed(s.observable_along()));
  }
  const std::vector<std::string> headings(3, "theta");
  return {
      studied(3, "4.1-relative-null-space", "(4.25)",
              "Null space of one segment: the distance of each feature",
              {.printed = "one vector for each",
               .measured = {"dimension with 1/2/3 features in {} motions {}; the printed vectors span it: {}",
                            motions, joined(found), yes_no(basis)}},
              basis),
      studied(
          maps.cases(), "4.1-relative-orientation", "below (4.25)",
          "The orientation is the one state that is observable in one segment, however many features",
          {.printed = "orientation",
           .measured = {"states outside the null space with 1/2/3 features: of Q_1 {}; of the motion itself "
                        "{}, which leaves the turn of all: {}",
                        fmt::join(in_segment, "/"), fmt::join(along, "/"), yes_no(maps.all(leaves_the_turn))},
           .why = "so it is by Q_1. The text itself doubts it (footnote 2): turning the vehicle and r of all "
                  "features changes no measurement"},
          in_segment == headings && along == headings)};
}

Claim footnote() {
  const Spaces spaces = lie(relative_map("planar"));
  const Study& s = relative();
  const bool turn_alone = are_basis(spaces, s.courses(), named({"rotation"})) && leaves_the_turn(s);
  return studied(
      "4.1-footnote-2", "footnote 2",
      "By Lie derivatives the orientation with respect to a global frame is not observable for the relative "
      "map",
      {.printed = "not observable",
       .measured = {"Lie derivatives leave {} at {} points, the motion itself {}: heading and map turned, {}",
                    joined({dimension(spaces)}), motions, joined({s.true_dimension()}),
                    turn_alone ? "both" : "not both"}},
      turn_alone);
}

std::vector<Claim> ahead_and_abeam() {
  const Study &s = straight_ahead(), &beside = abeam();
  const bool basis = s.stripped_spanned_by(1, r_x);
  const auto both = [](const Course& c) {
    return Basis{three(0, 1, 0), three(-r_to(c.points[0], 0).y(), 0, 1)};
  };
  return {
      studied("4.1-ahead", "below (4.25)",
              "With the feature straight ahead (r_y = 0) the unobservable mode of Q_1 is r_x",
              {.printed = "r_x",
               .measured = {"dimension {} in {} motions; it is r_x: {}", s.left(1), motions, yes_no(basis)}},
              basis),
      studied(
          "4.1-abeam", "below (4.25)", "With the feature abeam (r_x = 0) the unobservable mode of Q_1 is r_y",
          {.printed = "r_y",
           .measured = {"dimension {} in {} motions", beside.left(1), motions},
           .why = "r_y, and the heading together with r_x: the row H F is zero abeam, so that Q_1 is but H"},
          beside.stripped_spanned_by(1, always({three(0, 1, 0)})), beside.stripped_spanned_by(1, both))};
}

std::vector<Claim> two_segments() {
  const Studies maps = maps_of_three();
  const bool by_matrices = maps.all([](const Study&s) { return s.full_rank(2); }),
             printed = maps.all(fully_observable), turns = maps.all(leaves_the_turn);
  return {studied(maps.cases(), "4.1-relative-two-segments", "below (4.25)",
                  "SOM and TOM have full rank in two segments", {.printed = "0", .measured = maps.text()},
                  by_matrices),
          studied(maps.cases(), "4.1-relative-observable", "below (4.25), Section 4.4",
                  "Opposite to the world-centric map this system becomes fully observable in two segments",
                  {.printed = "fully",
                   .measured = {"{}. What is left is heading and map turned: {}", maps.text(),
                                turns ? "always" : "not always"},
                   .why = "up to the orientation of the axes: the map in the vehicle's frame becomes "
                          "observable, the direction of north does not, with any number of features. SOM and "
                          "TOM have full rank because H is frozen"},
                  printed && by_matrices, turns && by_matrices)};
}

/// Driving on, with the feature straight ahead for good, and abeam at first.
std::vector<Claim> straight_on() {
  const Study &s = straight_ahead(), &beside = abeam();
  const bool mode = for_all({1, 2, 3}, [&](int k) { return s.stripped_spanned_by(k, r_x); }),
             along = leaves_distance_and_turn(s);
  return {
      studied("4.1-ahead-for-good", "below (4.25)",
              "Driving straight at a feature the system remains unobservable, with mode r_x",
              {.printed = "r_x",
               .measured =
                   {"{}, in {} motions. SOM leaves r_x: {}; the motion itself r_x and the turn of all: {}",
                    s.text(), motions, yes_no(mode), yes_no(along)}},
              mode && along),
      studied("4.1-abeam-two-segments", "below (4.25)",
              "With the feature abeam at first SOM and TOM have full rank in two segments",
              {.printed = "0", .measured = {"{}, in {} motions straight on", beside.text(), motions}},
              beside.full_rank(2))};
}

Claim pure_rotation() {
  Studies maps("by features");
  for (const Change& change : {Change{}, turning()})
    for (const int features : {1, 2, 3})
      maps.add(fmt::format("{}{}:", features, change.apply ? ", turning" : ""),
               relative(features, "stationary", change));
  const bool one_more = maps.all([](const Study& s) {
    const std::vector<int> expected(3, s.which().features + 1);
    return s.dimensions() == expected && s.total_dimensions() == expected &&
           s.true_dimension() == expected[0];
  });
  std::set<std::string> seen;
  for (const Study& s : maps)
    for (const auto& states : {s.observable(3), s.observable_along()})
      seen.insert(states.begin(), states.end());
  return studied(maps.cases(), "4.1-pure-rotation", "below (4.25), Section 4.4",
                 "Without translation the null space has one vector more, SOM and TOM never have full rank, "
                 "and neither position nor orientation is recovered",
                 {.printed = "one more than features",
                  .measured = {"{}; states outside the null spaces: {}", maps.text(),
                               listed({seen.begin(), seen.end()})}},
                 one_more && seen.empty());
}

Claim no_rotation() {
  const Study &s = relative(1, "straight"), &ahead = straight_ahead();
  const bool as_matrices = s.left(2) == 0 && ahead.left(3) > 0;
  return studied(
      2, "4.1-no-rotation", "end of the relative map, Example 4.1",
      "Without rotation the system is completely observable in two segments, except with a feature on the "
      "line of sight",
      {.printed = "completely",
       .measured = {"{}: {}; straight ahead: {}", legend, s.numbers(), ahead.numbers()},
       .why = "up to the axes, as with rotation; on the line of sight the distance is missing too"},
      as_matrices && fully_observable(s),
      as_matrices && leaves_the_turn(s) && leaves_distance_and_turn(ahead));
}

}  // namespace

std::vector<Claim> relative_claims() {
  return concatenated({measurement_matrix(), one_segment(), footnote(), ahead_and_abeam(), two_segments(),
                       straight_on(), pure_rotation(), no_rotation()});
}

}  // namespace incognita::observability_claims::planar
