// Example 4.3: observability of a camera on a plane with unknown motion, without and with anchors. The
// relative map is in example_4_3_relative.cpp.
//
// Experiment: the built-in system `planar-cv`, motions and rules of observability_claims.hpp: velocity and
// turn rate constant within a segment, changed by an unknown amount from one to the next; 1 to 3 features, up
// to 4 anchors; also one segment alone, and at rest.
#include "experiments/common.hpp"
#include "experiments/observability_claims.hpp"

namespace incognita::observability_claims {
namespace {

const std::vector<std::string> velocities{"vx", "vy", "wz"},
    velocities_and_heading{"theta", "vx", "vy", "wz"}, of_vehicle{"x", "y", "theta", "vx", "vy", "wz"},
    of_all{"x", "y", "theta", "vx", "vy", "wz", "xf_1", "yf_1"};

const Study& world(int features = 1, int anchors = 0, const std::string& motion = "general") {
  return study({.system = "planar-cv", .features = features, .anchors = anchors, .motion = motion});
}

const Study& once(int anchors, const std::string& motion = "general") {
  return study({.system = "planar-cv", .anchors = anchors, .motion = motion, .segments = 1});
}

std::vector<Claim> without_anchors() {
  const Studies maps = by_features({1, 2, 3}, {.system = "planar-cv"});
  const Study& s = world();
  const auto by_Q_1 = s.observable(1), in_som = s.observable(3), along = s.observable_along();
  const bool turns = s.along_contains(named({"rotation", "scale"}));
  return {
      studied(maps.cases(), "4.3-world", "below (4.45)",
              "Without anchors Q_1 leaves six and no state outside its null space, the SOM of two segments "
              "leaves two",
              {.rule = Rule::dimension,
               .printed = "dim(N(Q_1)) = 6, dim(N(Q_SOM)) = 2",
               .measured = {"{}; states outside N(Q_1): {}", maps.text(), listed(by_Q_1)},
               .number = number_of("dimension of N(Q_SOM) of two segments, of 8", s.left(2)),
               .why = "if the SOM is that of three segments: 6, 4, 2"},
              s.dimensions() == std::vector{6, 2, 2} && by_Q_1.empty(),
              on_condition(s.dimensions() == std::vector{6, 4, 2} && by_Q_1.empty())),
      studied(
          "4.3-world-recovered", "below (4.45)",
          "Without anchors linear and angular velocities are recovered, and nothing else",
          {.rule = Rule::dimension,
           .measured = {"states outside the null space in {} motions: of the SOM of three segments {}; of "
                        "the motion itself {}, in whose null space all turned and all scaled are: {}",
                        motions, listed(in_som), listed(along), yes_no(turns)},
           .number = left_in_truth(s),
           .why = "the angular velocity alone is. Turning all, or scaling all from a point, changes no "
                  "bearing, and so the linear velocity is not observable. SOM adds even the heading"},
          InTruth{along == velocities, in_truth(turns && along == std::vector<std::string>{"wz"})},
          ByMethod{in_som == velocities, in_truth(in_som == velocities_and_heading)})};
}

std::vector<Claim> one_anchor() {
  const Study &s = world(1, 1), &at_once = once(1),
              &two_segments = study({.system = "planar-cv", .anchors = 1, .segments = 2});
  const auto by_Q_1 = s.observable(1), by_Q_1_of_two = world(1, 2).observable(1),
             along = at_once.observable_along(), along_two = once(2).observable_along();
  const Vectors turn_and_scale = about_anchor({"rotation", "scale"});
  const bool turns = s.along_spanned_by(turn_and_scale) && two_segments.along_spanned_by(turn_and_scale);
  return {
      studied("4.3-one-anchor", "below (4.46)",
              "With one anchor the rank of Q_1 is four, and the SOM of two segments leaves one",
              {.rule = Rule::dimension,
               .printed = "rank four, dim(N(Q_SOM,2)) = 1",
               .measured = {"rank {} of 8 in {} motions; {}", 8 - s.left(1), motions, s.text()},
               .number = number_of("dimension of N(Q_SOM,2) with one anchor, of 8", s.left(2))},
              s.left(1) == 4 && s.left(2) == 1),
      studied(4, "4.3-one-anchor-velocities", "below (4.46)",
              "With one anchor linear and angular velocities are recovered in the first segment",
              {.rule = Rule::dimension,
               .measured = {"states outside the null space in {} motions, with one anchor and with two: of "
                            "Q_1 {}, and {}; of one segment of the motion itself {}, and {}",
                            motions, listed(by_Q_1), listed(by_Q_1_of_two), listed(along), listed(along_two)},
               .number = left_in_truth(at_once, " of one segment, with one anchor"),
               .why = "the angular velocity is, the linear one is not: turning and scaling all about the "
                      "anchor changes no bearing. By Q_1 none is. Two anchors recover them all"},
              InTruth{along == velocities || along == of_all,
                      in_truth(along == std::vector<std::string>{"wz"} &&
                               at_once.along_spanned_by(turn_and_scale) && along_two == of_all)},
              ByMethod{by_Q_1 == velocities, in_truth(by_Q_1.empty() && by_Q_1_of_two == velocities)}),
      studied(2, "4.3-one-anchor-modes", "below (4.46)",
              "With one anchor two segments leave one direction that is not recovered",
              {.rule = Rule::dimension,
               .measured = {"{}, in {} motions, after two segments {}. That is turning all about the anchor "
                            "and scaling all from it: {}",
                            s.text(), motions, joined({two_segments.true_dimension()}), yes_no(turns)},
               .number = left_in_truth(two_segments, " of two segments, with one anchor"),
               .why = "two: turning all about the anchor, and scaling all from it. No further segment "
                      "recovers them, but in SOM and TOM the third does"},
              InTruth{two_segments.true_dimension() == 1, in_truth(turns && s.full_rank(3))},
              ByMethod{s.left(2) == 1})};
}

std::vector<Claim> two_anchors() {
  const Study &s = world(1, 2), &at_once = once(2);
  const auto by_Q_1 = s.observable(1), along = at_once.observable_along();
  return {studied("4.3-two-anchors-rank", "below (4.46)", "With two anchors Q_1 has rank six",
                  {.rule = Rule::dimension,
                   .measured = {"rank {} of 8 in {} motions", 8 - s.left(1), motions},
                   .number = exactly("rank of Q_1 with two anchors, of 8", 8 - s.left(1))},
                  s.left(1) == 2),
          studied(2, "4.3-two-anchors-velocities", "below (4.46)",
                  "With two anchors one segment recovers linear and angular velocities only",
                  {.rule = Rule::dimension,
                   .measured = {"states outside the null space in {} motions: of Q_1 {}; of one segment of "
                                "the motion itself {}, which leaves {}",
                                motions, listed(by_Q_1), listed(along), joined({at_once.true_dimension()})},
                   .number = left_in_truth(at_once, " of one segment, with two anchors"),
                   .why = "one segment recovers everything"},
                  InTruth{along == velocities, in_truth(along == of_all && fully_observable(at_once))},
                  ByMethod{by_Q_1 == velocities}),
          studied("4.3-two-anchors", "below (4.46)",
                  "With two anchors the system is fully observable in two segments",
                  {.rule = Rule::dimension,
                   .measured = {"{}, in {} motions", s.text(), motions},
                   .number = left_in_truth(s, ", with two anchors")},
                  InTruth{fully_observable(s)}, ByMethod{full_in_two(s)})};
}

Claim three_anchors() {
  const Studies anchored = by_anchors({3, 4}, {.system = "planar-cv"});
  const auto found = anchored.each([](const Study& s) { return s.left(1); });
  const bool basis = anchored.all([](const Study& s) { return s.stripped_spanned_by(1, named({"depth"})); });
  return studied(2, "4.3-three-anchors", "(4.47)",
                 "With more than two anchors the distance of the feature spans the null space of Q_1",
                 {.rule = Rule::dimension,
                  .measured = {"dimension with 3/4 anchors in {} motions {}; the printed vector spans it: {}",
                               motions, joined(found), yes_no(basis)},
                  .number = number_of("dimension of N(Q_1) with three anchors, of 8", found[0])},
                 basis);
}

Claim translating() {
  const Study &moves = world(1, 3), &rests = world(1, 3, "stationary"), &moved = once(3),
              &rested = once(3, "stationary");
  const auto by_Q_1 = rests.observable(1), along = rested.observable_along();
  return studied(4, "4.3-translating", "below (4.47)",
                 "With more than two anchors position, orientation and velocities are recovered in the first "
                 "segment only if the camera is translating",
                 {.rule = Rule::dimension,
                  .measured = {"states outside the null space at rest with three anchors in {} motions: of "
                               "Q_1 {}; of one segment of the motion itself {}. Moving it leaves {}",
                               motions, listed(by_Q_1), listed(along), joined({moved.true_dimension()})},
                  .number = left_in_truth(rested, " of one segment at rest: the distance of the feature"),
                  .why = "at rest as well: three bearings determine a pose, and their rates the velocities. "
                         "Only the feature needs translation"},
                 InTruth{fully_observable(moved) && along != of_vehicle,
                         in_truth(fully_observable(moved) && along == of_vehicle &&
                                  rested.along_spanned_by(named({"depth"})))},
                 ByMethod{moves.observable(1) == of_vehicle && by_Q_1 != of_vehicle,
                          in_truth(moves.observable(1) == of_vehicle && by_Q_1 == of_vehicle)});
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
                 {.rule = Rule::dimension,
                  .measured = {"largest difference of F from exact derivatives {}; dimension {}; (4.9) holds "
                               "with 3 anchors in {} of {} motions, with one {}",
                               below(difference), dimension(spaces), s.stays() ? "all" : "not all", motions,
                               world(1, 1).stays() ? "too" : "not"},
                  .number = number_of("dimension of N(F), of 8", dimension(spaces))},
                 difference < rounding && basis && s.stays() && world(1, 4).stays());
}

Claim three_anchors_two_segments() {
  const Studies anchored = by_anchors({3, 4}, {.system = "planar-cv"});
  return studied(anchored.cases(), "4.3-three-anchors-two-segments", "below (4.48)",
                 "With more than two anchors SOM and TOM have full rank in two segments",
                 {.rule = Rule::dimension,
                  .measured = anchored.text(),
                  .number = number_of("dimensions left by the SOM of two segments with three anchors",
                                      world(1, 3).left(2))},
                 anchored.all(full_in_two));
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
