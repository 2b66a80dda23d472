// Example 4.3: observability of a camera on a plane with unknown motion, without and with anchors. The
// relative map is in example_4_3_relative.cpp.
//
// Experiment: the built-in system `planar-cv`, motions and rules of observability_claims.hpp: velocity and
// turn rate constant within a segment, changed by an unknown amount from one to the next; 1 to 3 features, up
// to 4 anchors; also at rest.
#include "experiments/common.hpp"
#include "experiments/observability_claims.hpp"

namespace incognita::observability_claims {
namespace {

const std::vector<std::string> velocities{"vx", "vy", "wz"},
    velocities_and_heading{"theta", "vx", "vy", "wz"}, of_vehicle{"x", "y", "theta", "vx", "vy", "wz"};

const Study& world(int features = 1, int anchors = 0, const std::string& motion = "general") {
  return study({.system = "planar-cv", .features = features, .anchors = anchors, .motion = motion});
}

std::vector<Claim> without_anchors() {
  const Studies maps = by_features({1, 2, 3}, {.system = "planar-cv"});
  const Study& s = world();
  const auto at_once = s.observable(1), in_som = s.observable(3), along = s.observable_along();
  const bool turns = s.along_contains(named({"rotation", "scale"}));
  return {
      studied(maps.cases(), "4.3-world", "below (4.45)",
              "Without anchors one segment leaves six and recovers no state, the SOM leaves two",
              {.printed = "6, then 2",
               .measured = {"{}; states outside N(Q_1): {}", maps.text(), listed(at_once)},
               .why = "two only after three segments: 6, 4, 2"},
              s.dimensions() == std::vector{6, 2, 2} && at_once.empty(),
              s.dimensions() == std::vector{6, 4, 2} && at_once.empty()),
      studied(
          "4.3-world-recovered", "below (4.45)",
          "Without anchors linear and angular velocities are recovered, and nothing else",
          {.printed = "velocities",
           .measured = {"states outside the null space in {} motions: of the SOM of three segments {}; of "
                        "the motion itself {}",
                        motions, listed(in_som), listed(along)},
           .why = "the angular velocity alone. Turning all, or scaling all from a point, changes no bearing, "
                  "and so the linear velocity is not observable either. SOM adds even the heading"},
          along == velocities && in_som == velocities,
          turns && along == std::vector<std::string>{"wz"} && in_som == velocities_and_heading)};
}

std::vector<Claim> one_anchor() {
  const Study& s = world(1, 1);
  const auto one = s.observable(1), two = world(1, 2).observable(1);
  const bool turns = s.along_spanned_by(about_anchor({"rotation", "scale"}));
  return {
      studied("4.3-one-anchor", "below (4.46)",
              "With one anchor the rank of Q_1 is four, and the SOM of two segments leaves one",
              {.printed = "4 of 8, 1",
               .measured = {"rank {} of 8 in {} motions; {}", 8 - s.left(1), motions, s.text()}},
              s.left(1) == 4 && s.left(2) == 1),
      studied(
          2, "4.3-one-anchor-velocities", "below (4.46)",
          "With one anchor linear and angular velocities are recovered in the first segment",
          {.printed = "velocities",
           .measured = {"states outside N(Q_1) in {} motions, by anchors: 1: {}; 2: {}", motions, listed(one),
                        listed(two)},
           .why =
               "a feature and an anchor give two equations for three velocities. Two anchors give the third"},
          one == velocities),
      studied(
          "4.3-one-anchor-for-good", "below (4.46)",
          "With one anchor no more than these directions are recovered: one remains unobservable",
          {.printed = "1",
           .measured = {"{}, in {} motions; turning all about the anchor and scaling all from it: {}",
                        s.text(), motions, turns ? "that is it" : "that is not it"},
           .why = s.full_rank(3) && turns
                      ? "with a third segment SOM and TOM have full rank, and the motion itself leaves two"
                      : ""},
          s.left(3) == 1 && s.true_dimension() == 1)};
}

Claim two_anchors() {
  const Study& s = world(1, 2);
  const auto seen = s.observable(1);
  return studied("4.3-two-anchors", "below (4.46)",
                 "With two anchors Q_1 has rank six and recovers velocities only; two segments make the "
                 "system fully observable",
                 {.printed = "6 of 8, 0",
                  .measured = {"rank {} of 8 in {} motions, states outside N(Q_1): {}; {}", 8 - s.left(1),
                               motions, listed(seen), s.text()}},
                 s.left(1) == 2 && seen == velocities && observable_in_two(s));
}

Claim three_anchors() {
  const Studies anchored = by_anchors({3, 4}, {.system = "planar-cv"});
  const auto found = anchored.each([](const Study& s) { return s.left(1); });
  const bool basis = anchored.all([](const Study& s) { return s.stripped_spanned_by(1, named({"depth"})); });
  return studied(2, "4.3-three-anchors", "(4.47)",
                 "Null space of one segment with more than two anchors: the distance of the feature",
                 {.printed = "dimension 1",
                  .measured = {"dimension with 3/4 anchors in {} motions {}; the printed vector spans it: {}",
                               motions, joined(found), yes_no(basis)}},
                 basis);
}

Claim translating() {
  const Study& s = world(1, 3, "stationary");
  const auto at_rest = s.observable(1), moving = world(1, 3).observable(1);
  return studied(2, "4.3-translating", "below (4.47)",
                 "With more than two anchors position, orientation and velocities are recovered in the first "
                 "segment only if the camera is translating",
                 {.printed = "only if translating",
                  .measured = {"states outside N(Q_1) with three anchors in {} motions each, moving: {}; at "
                               "rest: {}. At rest {}",
                               motions, listed(moving), listed(at_rest), s.text()},
                  .why = "three bearings determine a pose, and their rates the velocities, at rest as well: "
                         "neither F nor H depends on the velocity. Only the feature needs translation"},
                 moving == of_vehicle && at_rest != of_vehicle);
}

Claim f_null_space() {
  const Study& s = world(1, 3);
  MatrixXd printed = MatrixXd::Zero(8, 8);
  printed.block<3, 3>(0, 3).setIdentity();
  const double difference = largest(s, [&](const Course& c) { return apart(c.exact[0].F, printed); });
  const Spaces spaces = null_spaces(s, [](const Course& c) { return c.forms[0].F; });
  const MatrixXd I = MatrixXd::Identity(8, 8);
  const bool basis =
      are_basis(spaces, s.courses(), always({I.col(0), I.col(1), I.col(2), I.col(6), I.col(7)}));
  return studied(2, "4.3-F-null-space", "(4.46), (4.48)",
                 "F and its null space, which contains N(Q_j) with more than two anchors",
                 {.printed = "dimension 5",
                  .measured = {"largest difference of F from exact derivatives {}; dimension {}; (4.9) holds "
                               "with 3 anchors in {} of {} motions, with one {}",
                               below(difference), dimension(spaces), s.stays() ? "all" : "not all", motions,
                               world(1, 1).stays() ? "too" : "not"}},
                 difference < rounding && basis && s.stays() && world(1, 4).stays());
}

Claim three_anchors_two_segments() {
  const Studies anchored = by_anchors({3, 4}, {.system = "planar-cv"});
  return studied(anchored.cases(), "4.3-three-anchors-two-segments", "below (4.48)",
                 "With more than two anchors SOM and TOM have full rank in two segments",
                 {.printed = "0", .measured = anchored.text()},
                 anchored.all([](const Study& s) { return s.full_rank(2) && fully_observable(s); }));
}

LedgerEntry run_example_4_3(const ExperimentSettings& settings) {
  return entry_of(example_4_3, settings,
                  {without_anchors(), one_anchor(), two_anchors(), three_anchors(), translating(),
                   f_null_space(), three_anchors_two_segments(), planar_cv_relative_claims()});
}

}  // namespace
}  // namespace incognita::observability_claims

const incognita::Experiment incognita::example_4_3{
    "4.3", "Bearings at constant velocity on a plane", {}, observability_claims::run_example_4_3};
