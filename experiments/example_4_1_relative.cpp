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

const Vectors turn_of_all = named({"rotation"});

bool leaves_the_turn(const Study& s) { return s.along_spanned_by(turn_of_all); }
/// Why SOM and TOM do not leave it.
bool frozen_rows_see_the_turn(const Study& s) { return seen_by_frozen_rows_only(s, turn_of_all); }

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
                 {.printed = "[r_y/d^2 -r_x/d^2 -1 ... 0 0 0]",
                  .measured = {"largest difference in {} motions: {}", motions, worst.text()},
                  .number = exactly("largest difference of the printed entries", worst.printed),
                  .why = "[-r_y r_x]/d^2 for r = x_f - p (what is printed belongs to p - x_f), and -1 in the "
                         "last column, the heading's"},
                 worst, rounding);
}

std::vector<Claim> map_in_one_segment() {
  const Studies maps = maps_of_three();
  const auto found = maps.each([](const Study& s) { return s.left(1); });
  const bool basis = maps.all([](const Study& s) { return s.stripped_spanned_by(1, named({"depth"})); });
  std::vector<std::string> in_segment, along;
  for (const Study& s : maps) {
    in_segment.push_back(listed(s.observable(1)));
    along.push_back(listed(s.observable_along()));
  }
  const std::vector<std::string> headings(3, "theta"), nothing(3, "none");
  return {
      studied(3, "4.1-relative-null-space", "(4.25)",
              "The distance of each feature spans the null space of Q_1: one vector for each",
              {.rule = Rule::dimension,
               .measured = {"dimension with 1/2/3 features in {} motions {}; the printed vectors span it: {}",
                            motions, joined(found), yes_no(basis)},
               .number = number_of("dimension of N(Q_1) with three features, of 7", found[2])},
              basis),
      studied(
          maps.cases(), "4.1-relative-orientation", "below (4.25), Section 4.4",
          "The orientation is the one state that is observable in one segment, however many features",
          {.rule = Rule::dimension,
           .measured = {"states outside the null space with 1/2/3 features: of Q_1 {}; of the motion "
                        "itself, in three segments, {}; it leaves the turn of all: {}",
                        fmt::join(in_segment, "/"), fmt::join(along, "/"), yes_no(maps.all(leaves_the_turn))},
           .number = exactly("states that three segments of the motion make observable, with one feature",
                             static_cast<double>(relative().observable_along().size())),
           .why = "no state is. The text itself doubts it (footnote 2): turning the vehicle and r of all "
                  "features changes no measurement. Q_1 has it because H is frozen in H F"},
          InTruth{along == headings, in_truth(along == nothing && maps.all(leaves_the_turn) &&
                                              maps.all(frozen_rows_see_the_turn))},
          ByMethod{in_segment == headings})};
}

Claim footnote() {
  const Spaces spaces = lie(relative_map("planar"));
  const Study& s = relative();
  const bool turn_alone = are_basis(spaces, s.courses(), turn_of_all) && leaves_the_turn(s);
  const auto by_som = s.observable(2);
  return studied(
      "4.1-footnote-2", "footnote 2",
      "The orientation with respect to a global frame is not observable for the relative map (by Lie "
      "derivatives)",
      {.rule = Rule::dimension,
       .measured =
           {"Lie derivatives leave {} at {} points, the motion itself {}: heading and map turned, {}. "
            "By the SOM of two segments observable: {}",
            joined({dimension(spaces)}), motions, joined({s.true_dimension()}),
            turn_alone ? "both" : "not both", listed(by_som)},
       .number = number_of("dimensions left by the Lie derivatives", dimension(spaces))},
      InTruth{turn_alone}, ByMethod{std::ranges::count(by_som, "theta") == 0, in_truth(full_in_two(s))});
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
              {.rule = Rule::dimension,
               .measured = {"dimension {} in {} motions; it is r_x: {}", s.left(1), motions, yes_no(basis)},
               .number = number_of("dimension of N(Q_1), feature straight ahead", s.left(1))},
              basis),
      studied(
          "4.1-abeam", "below (4.25)", "With the feature abeam (r_x = 0) the unobservable mode of Q_1 is r_y",
          {.rule = Rule::dimension,
           .measured = {"dimension {} in {} motions; r_y, and heading with r_x, span it: {}", beside.left(1),
                        motions, yes_no(beside.stripped_spanned_by(1, both))},
           .number = number_of("dimension of N(Q_1), feature abeam", beside.left(1)),
           .why = "there are two: r_y, and the heading together with r_x. The row H F is zero abeam, so that "
                  "Q_1 is but H"},
          beside.stripped_spanned_by(1, always({three(0, 1, 0)})),
          in_truth(beside.stripped_spanned_by(1, both)))};
}

std::vector<Claim> two_segments() {
  const Studies maps = maps_of_three();
  const bool turns = maps.all(leaves_the_turn) && maps.all(frozen_rows_see_the_turn);
  return {studied(maps.cases(), "4.1-relative-two-segments", "below (4.25)",
                  "SOM and TOM have full rank in two segments",
                  {.rule = Rule::dimension,
                   .measured = maps.text(),
                   .number = number_of("dimensions left by the SOM of two segments, one feature",
                                       relative().left(2))},
                  maps.all(full_in_two)),
          studied(maps.cases(), "4.1-relative-observable", "below (4.25), Sections 4.4 and 7.1",
                  "Opposite to the world-centric map this system becomes fully observable in two segments",
                  {.rule = Rule::dimension,
                   .measured = {"{}. What is left is heading and map turned, and only H F sees it: {}",
                                maps.text(), turns ? "always" : "not always"},
                   .number = left_in_truth(relative(), ", with one feature"),
                   .why = "one direction is left for good, with any number of features: the map in the "
                          "vehicle's frame becomes observable, the direction of north does not. SOM and TOM "
                          "have full rank because H is frozen"},
                  InTruth{maps.all(fully_observable), in_truth(turns)}, ByMethod{maps.all(full_in_two)})};
}

/// Driving on, with the feature straight ahead for good, and abeam at first.
std::vector<Claim> straight_on() {
  const Study &s = straight_ahead(), &beside = abeam();
  const bool mode = for_all({1, 2, 3}, [&](int k) { return s.stripped_spanned_by(k, r_x); }),
             along = leaves_distance_and_turn(s);
  return {
      studied("4.1-ahead-for-good", "below (4.25)",
              "Driving straight at a feature the system remains unobservable, with mode r_x",
              {.rule = Rule::dimension,
               .measured =
                   {"{}, in {} motions. SOM leaves r_x: {}; the motion itself r_x and the turn of all: {}",
                    s.text(), motions, yes_no(mode), yes_no(along)},
               .number = left_in_truth(s, ", straight at the feature")},
              InTruth{along && s.along_contains(r_x)}, ByMethod{mode}),
      studied("4.1-abeam-two-segments", "below (4.25)",
              "With the feature abeam at first SOM and TOM have full rank in two segments",
              {.rule = Rule::dimension,
               .measured = {"{}, in {} motions straight on", beside.text(), motions},
               .number = number_of("dimensions left by the SOM of two segments", beside.left(2))},
              full_in_two(beside))};
}

std::set<std::string> as_set(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

Claim pure_rotation() {
  Studies maps("by features");
  for (const Change& change : {Change{}, turning()})
    for (const int features : {1, 2, 3})
      maps.add(fmt::format("{}{}:", features, change.apply ? ", turning" : ""),
               relative(features, "stationary", change));
  const bool one_more = maps.all([](const Study& s) {
    const std::vector<int> expected(3, s.which().features + 1);
    return s.dimensions() == expected && s.total_dimensions() == expected;
  });
  const bool truly = maps.all([](const Study& s) { return s.true_dimension() == s.which().features + 1; });
  std::set<std::string> by_som, along;
  for (const Study& s : maps) {
    by_som.merge(as_set(s.observable(3)));
    along.merge(as_set(s.observable_along()));
  }
  return studied(
      maps.cases(), "4.1-pure-rotation", "below (4.25), Section 4.4",
      "Without translation the null space has one vector more, SOM and TOM never have full rank, "
      "and neither position nor orientation is recovered",
      {.rule = Rule::dimension,
       .measured = {"{}; states outside the null space of SOM: {}, of the motion itself: {}", maps.text(),
                    listed({by_som.begin(), by_som.end()}), listed({along.begin(), along.end()})},
       .number = left_in_truth(relative(1, "stationary"), ", at rest, one feature")},
      InTruth{truly && along.empty()}, ByMethod{one_more && by_som.empty()});
}

Claim no_rotation() {
  const Study &s = relative(1, "straight"), &ahead = straight_ahead();
  return studied(
      2, "4.1-no-rotation", "end of the relative map, Example 4.1",
      "Without rotation the system is completely observable in two segments, except with a feature on the "
      "line of sight",
      {.rule = Rule::dimension,
       .measured = {"{}: {}; straight ahead: {}", legend, s.numbers(), ahead.numbers()},
       .number = left_in_truth(s, ", straight on"),
       .why = "the turn of all is left, as with rotation; on the line of sight the distance, too"},
      InTruth{fully_observable(s) && partially_observable(ahead),
              in_truth(leaves_the_turn(s) && leaves_distance_and_turn(ahead))},
      ByMethod{full_in_two(s) && never_full(ahead)});
}

}  // namespace

std::vector<Claim> relative_claims() {
  return concatenated({measurement_matrix(), map_in_one_segment(), footnote(), ahead_and_abeam(),
                       two_segments(), straight_on(), pure_rotation(), no_rotation()});
}

}  // namespace incognita::observability_claims::planar
