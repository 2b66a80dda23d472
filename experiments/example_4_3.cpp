// Example 4.3: observability of a camera on a plane with unknown motion, without and with anchors. The
// relative map is in example_4_3_relative.cpp.
//
// Experiment: the built-in system `planar-cv`, motions and rules of observability_claims.hpp: velocity and
// turn rate constant within a segment, changed by an unknown amount from one to the next; 1 to 3 features, up
// to 4 anchors; also at rest.
#include "experiments/example_4_3.hpp"
#include "experiments/common.hpp"

namespace incognita::observability_claims {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

const std::vector<std::string> velocities{"vx", "vy", "wz"},
    velocities_and_heading{"theta", "vx", "vy", "wz"}, of_vehicle{"x", "y", "theta", "vx", "vy", "wz"};

const Study& world(int features = 1, int anchors = 0, const std::string& motion = "general") {
  return study({.system = "planar-cv", .features = features, .anchors = anchors, .motion = motion});
}

std::vector<std::string> observable_in_segment(const Study& s) {
  return observable_states(s.stripped(1), s.error_states());
}

/// Everything turned about a point, and scaled from it.
Basis turn_and_scale(const SystemPoint& p, const Vector2d& about) {
  VectorXd turn = VectorXd::Zero(8), scale = turn;
  const Vector2d to_vehicle = p.x.head<2>() - about, v = p.x.segment<2>(3),
                 to_feature = p.x.tail<2>() - about;
  turn << -to_vehicle.y(), to_vehicle.x(), 1, -v.y(), v.x(), 0, -to_feature.y(), to_feature.x();
  scale << to_vehicle, 0, v, 0, to_feature;
  return {turn, scale};
}

Claim world_dimensions() {
  const Cases cases =
      by_number({1, 2, 3}, [](int features) { return CaseResult{world(features).numbers()}; });
  const std::vector<int> found = world().dimensions();
  return studied("4.3-world", "below (4.45)",
                 "Without anchors one segment leaves six and recovers no state, the SOM leaves two",
                 {.printed = "6, then 2",
                  .measured = fmt::format("{}, by features: {}; states outside N(Q_1): {}", legend,
                                          cases.text(), listed(observable_in_segment(world()))),
                  .why = "two only after three segments: 6, 4, 2",
                  .runs = 3 * motions},
                 found == std::vector{6, 2, 2} && observable_in_segment(world()).empty(),
                 found == std::vector{6, 4, 2} && observable_in_segment(world()).empty());
}

Claim world_recovered() {
  const Study& s = world();
  const auto in_som = observable_states(s.stripped(3), s.error_states()),
             along = observable_states(s.along(), s.states());
  const bool turns =
      s.along_contains([](const Course& c) { return turn_and_scale(c.points[0], Vector2d::Zero()); });
  return studied(
      "4.3-world-recovered", "below (4.45)",
      "Without anchors linear and angular velocities are recovered, and nothing else",
      {.printed = "velocities",
       .measured = fmt::format("states outside the null space in {} motions: of the SOM of three segments "
                               "{}; of the motion itself {}",
                               motions, listed(in_som), listed(along)),
       .why = "the angular velocity alone. Turning all, or scaling all from a point, changes no bearing, and "
              "so the linear velocity is not observable either. SOM adds even the heading"},
      along == velocities && in_som == velocities,
      turns && along == std::vector<std::string>{"wz"} && in_som == velocities_and_heading);
}

// Anchors ---------------------------------------------------------------------------------------------

Claim one_anchor() {
  const Study& s = world(1, 1);
  return studied("4.3-one-anchor", "below (4.46)",
                 "With one anchor the rank of Q_1 is four, and the SOM of two segments leaves one",
                 {.printed = "4 of 8, 1",
                  .measured = fmt::format("rank {} of 8 in {} motions; {}", 8 - dimension(s.stripped(1)),
                                          motions, s.text())},
                 dimension(s.stripped(1)) == 4 && dimension(s.stripped(2)) == 1);
}

Claim one_anchor_velocities() {
  const auto one = observable_in_segment(world(1, 1)), two = observable_in_segment(world(1, 2));
  return studied(
      "4.3-one-anchor-velocities", "below (4.46)",
      "With one anchor linear and angular velocities are recovered in the first segment",
      {.printed = "velocities",
       .measured = fmt::format("states outside N(Q_1) in {} motions, by anchors: 1: {}; 2: {}", motions,
                               listed(one), listed(two)),
       .why = "a feature and an anchor give two equations for three velocities. Two anchors give the third",
       .runs = 2 * motions},
      one == velocities);
}

Claim one_anchor_for_good() {
  const Study& s = world(1, 1);
  const bool turns =
      s.along_spanned_by([](const Course& c) { return turn_and_scale(c.points[0], c.points[0].anchors); });
  const bool takes_it = s.full_rank(3);
  return studied(
      "4.3-one-anchor-for-good", "below (4.46)",
      "With one anchor no more than these directions are recovered: one remains unobservable",
      {.printed = "1",
       .measured = fmt::format("{}, in {} motions; turning all about the anchor and scaling all from it: {}",
                               s.text(), motions, turns ? "that is it" : "that is not it"),
       .why = takes_it && turns
                  ? "with a third segment SOM and TOM have full rank, and the motion itself leaves two"
                  : ""},
      dimension(s.stripped(3)) == 1 && s.true_dimension() == 1);
}

Claim two_anchors() {
  const Study& s = world(1, 2);
  const auto seen = observable_in_segment(s);
  return studied("4.3-two-anchors", "below (4.46)",
                 "With two anchors Q_1 has rank six and recovers velocities only; two segments make the "
                 "system fully observable",
                 {.printed = "6 of 8, 0",
                  .measured = fmt::format("rank {} of 8 in {} motions, states outside N(Q_1): {}; {}",
                                          8 - dimension(s.stripped(1)), motions, listed(seen), s.text())},
                 dimension(s.stripped(1)) == 2 && seen == velocities && dimension(s.stripped(2)) == 0 &&
                     s.true_dimension() == 0);
}

Claim three_anchors() {
  bool basis = true;
  std::vector<int> found;
  for (const int anchors : {3, 4}) {
    const Study& s = world(1, anchors);
    found.push_back(dimension(s.stripped(1)));
    basis = basis && s.stripped_spanned_by(1, [](const Course& c) -> Basis {
      VectorXd v = VectorXd::Zero(8);
      v.tail<2>() = c.points[0].x.head<2>() - c.points[0].x.tail<2>();
      return {v};
    });
  }
  return studied(
      "4.3-three-anchors", "(4.47)",
      "Null space of one segment with more than two anchors: the distance of the feature",
      {.printed = "dimension 1",
       .measured = fmt::format("dimension with 3/4 anchors in {} motions {}; the printed vector spans it: {}",
                               motions, joined(found), yes_no(basis)),
       .runs = 2 * motions},
      basis);
}

Claim translating() {
  const auto at_rest = observable_in_segment(world(1, 3, "stationary")),
             moving = observable_in_segment(world(1, 3));
  const Study& s = world(1, 3, "stationary");
  return studied(
      "4.3-translating", "below (4.47)",
      "With more than two anchors position, orientation and velocities are recovered in the first segment "
      "only if the camera is translating",
      {.printed = "only if translating",
       .measured = fmt::format(
           "states outside N(Q_1) with three anchors in {} motions each, moving: {}; at rest: {}. At rest {}",
           motions, listed(moving), listed(at_rest), s.text()),
       .why = "three bearings determine a pose, and their rates the velocities, at rest as well: neither F "
              "nor H depends on the velocity. Only the feature needs translation",
       .runs = 2 * motions},
      moving == of_vehicle && at_rest != of_vehicle);
}

Claim f_null_space() {
  const Study& s = world(1, 3);
  const auto printed_f = [] {
    MatrixXd F = MatrixXd::Zero(8, 8);
    F.block<3, 3>(0, 3).setIdentity();
    return F;
  }();
  const double difference =
      largest(s, [&](const Course& c) { return (c.exact[0].F - printed_f).cwiseAbs().maxCoeff(); });
  const Spaces spaces = null_spaces(s, [](const Course& c) { return c.forms[0].F; });
  const bool basis = are_basis(spaces, s.courses(), [](const Course&) {
    const MatrixXd I = MatrixXd::Identity(8, 8);
    return Basis{I.col(0), I.col(1), I.col(2), I.col(6), I.col(7)};
  });
  return studied("4.3-F-null-space", "(4.46), (4.48)",
                 "F and its null space, which contains N(Q_j) with more than two anchors",
                 {.printed = "dimension 5",
                  .measured = fmt::format("largest difference of F from exact derivatives {}; dimension {}; "
                                          "(4.9) holds with 3 anchors in {} of {} motions, with one {}",
                                          below(difference), dimension(spaces), s.stays() ? "all" : "not all",
                                          motions, world(1, 1).stays() ? "too" : "not"),
                  .runs = 2 * motions},
                 difference < planar_cv::rounding && basis && s.stays() && world(1, 4).stays());
}

Claim three_anchors_two_segments() {
  const Cases cases = by_number({3, 4}, [](int anchors) -> CaseResult {
    const Study& s = world(1, anchors);
    return {s.numbers(), s.full_rank(2) && s.true_dimension() == 0};
  });
  return studied("4.3-three-anchors-two-segments", "below (4.48)",
                 "With more than two anchors SOM and TOM have full rank in two segments",
                 {.printed = "0",
                  .measured = fmt::format("{}, by anchors: {}", legend, cases.text()),
                  .runs = 2 * motions},
                 cases.hold());
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(example_4_3, settings,
                  concatenated({{world_dimensions(), world_recovered(), one_anchor(), one_anchor_velocities(),
                                 one_anchor_for_good(), two_anchors(), three_anchors(), translating(),
                                 f_null_space(), three_anchors_two_segments()},
                                planar_cv::relative_claims()}));
}

}  // namespace
}  // namespace incognita::observability_claims

namespace incognita {

const Experiment example_4_3{
    "4.3", "Bearings at constant velocity on a plane", {}, observability_claims::run};

}  // namespace incognita
