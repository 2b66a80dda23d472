// Example 4.2: observability of a body with inertial sensors and a camera, without and with anchors. Its
// matrices are in example_4_2_matrices.cpp, the relative map in example_4_2_relative.cpp.
//
// Experiment: the built-in systems `inertial` and `inertial-rb` (azimuth, elevation; and range), motions and
// rules of observability_claims.hpp; 1 to 3 features, up to 4 anchors, also two of them one above the other;
// also one segment alone, and unaccelerated, in each of the ways that `f = 0` may mean: falling, without gravity, and (f = -g then)
// at constant velocity under gravity.
#include "experiments/example_4_2.hpp"
#include "experiments/common.hpp"

namespace incognita::observability_claims::inertial {
namespace {

const std::vector<std::string> velocities{"vx", "vy", "vz"},
    of_vehicle{"x", "y", "z", "vx", "vy", "vz", "psi_x", "psi_y", "psi_z"},
    velocities_and_feature{"vx", "vy", "vz", "xf_1", "yf_1", "zf_1"};

VectorXd twelve(const Vector3d& p, const Vector3d& v, const Vector3d& psi, const Vector3d& feature) {
  return (VectorXd(12) << p, v, psi, feature).finished();
}

const Vectors yaw = named({"rotation about z"});

const Study& with_anchors(int anchors, int features = 1) { return study(world(features, anchors)); }

/// The motion of one segment.
const Study& of_one_segment(Case which) {
  which.segments = 1;
  return study(which);
}

std::vector<Claim> without_anchors() {
  const Study& s = study(world());
  const bool basis = for_all({2, 3}, [&](int k) { return s.stripped_spanned_by(k, named({"translation"})); });
  const auto in_som = s.observable(3), along = s.observable_along();
  const std::vector<std::string> printed_of_som{"vx", "vy", "vz", "psi_x", "psi_y", "psi_z"},
      printed{"vx", "vy", "vz", "phi", "theta", "psi"}, ours{"vz", "phi", "theta"};
  const bool yaws = s.along_contains(yaw);
  const Studies with_ranges = by_features({1, 2}, {.system = "inertial-rb"});
  return {
      studied("4.2-world-null-space", "(4.35)",
              "The three translations of vehicle and feature span the null space of the SOM",
              {.rule = Rule::dimension,
               .measured = {"{}, in {} motions; the printed vectors span that of two and three segments: {}. "
                            "The state has {} entries; printed are vectors of 14",
                            s.text(), motions, yes_no(basis), s.error_states().size()},
               .number = number_of("dimension of N(Q_SOM) of two segments, of 12", s.left(2))},
              basis),
      studied(
          "4.2-world-recovered", "below (4.35)",
          "Not fully observable: linear velocity and misalignments are recovered, and nothing else",
          {.rule = Rule::dimension,
           .measured =
               {"states outside the null space in {} motions: of the SOM {}; of the motion itself {}, "
                "which leaves {} dimensions, the turn about a vertical among them: {}",
                motions, listed(in_som), listed(along), joined({s.true_dimension()}), yes_no(yaws)},
           .number = left_in_truth(s),
           .why =
               "of both only what gravity determines: vertical speed, roll and pitch. Turning all about a "
               "vertical changes no measurement, so that heading and horizontal velocity are not recovered"},
          InTruth{along == printed, in_truth(along == ours && yaws && s.true_dimension() == 4)},
          ByMethod{in_som == printed_of_som}),
      studied(with_ranges.cases(), "4.2-range-bearing-world", "below (4.28), of [19]",
              "With range and bearing the world-centric map is partially observable",
              {.rule = Rule::dimension,
               .measured = with_ranges.text(),
               .number = left_in_truth(*with_ranges.begin(), ", with one feature")},
              InTruth{with_ranges.all(partially_observable)}, ByMethod{with_ranges.all(never_full)})};
}

Claim few_anchors() {
  Case one_above_the_other = world(1, 2);
  one_above_the_other.change = {"vertical", [](SystemText& text) {
                                  auto& region = text.anchor->region;
                                  region[0].low = region[0].high = 5;
                                  region[1].low = region[1].high = -4;
                                }};
  Studies anchored("by anchors");
  const Study &one = anchored.add("1:", with_anchors(1)), &two = anchored.add("2:", with_anchors(2)),
              &vertical = anchored.add("2, one above the other:", study(one_above_the_other));
  const bool but_the_yaw = one.along_spanned_by(about_anchor({"rotation about z"}));
  return studied(
      anchored.cases(), "4.2-few-anchors", "head of Section 4.1.2, below (4.37)",
      "One or two anchors leave the system partially observable; it takes more than two",
      {.rule = Rule::dimension,
       .measured = anchored.text(),
       .number = left_in_truth(two, ", with two anchors"),
       .why = "two are enough, unless one is above the other; one leaves the turn about the "
              "vertical through it. By SOM and TOM one is enough"},
      InTruth{partially_observable(one) && partially_observable(two),
              in_truth(but_the_yaw && fully_observable(two) && vertical.true_dimension() == 1)},
      ByMethod{never_full(one) && never_full(two), in_truth(full_in_two(one) && full_in_two(two))});
}

/// As printed: r in axes of the sensor, f in those of the world.
Basis vectors_4_38(const Course& c) {
  const Begin b(c);
  const Vector3d zero = Vector3d::Zero();
  return {twelve(zero, zero, zero, b.C * b.r), twelve(b.r.cross(b.f), zero, b.f, zero)};
}

Claim anchored_null_space() {
  const Study &three = with_anchors(3), &four = with_anchors(4), &none = with_anchors(0);
  const auto both = [&](const Vectors& vectors) {
    return three.stripped_spanned_by(1, vectors) && four.stripped_spanned_by(1, vectors);
  };
  const bool without =
      contain(none.stripped(1), none.courses(), [](const Course& c) { return Basis{vectors_4_38(c)[1]}; });
  const auto by_features = each_of({1, 2, 3}, [](int n) { return with_anchors(3, n).left(1); });
  return studied(
      5, "4.2-anchored-null-space", "(4.38)",
      "With three or more anchors and one feature the two vectors of (4.38) span the null space of Q_1",
      {.rule = Rule::dimension,
       .printed = "[0 0 0 C r], [r x f 0 f 0]",
       .measured = {"dimension with 3 and 4 anchors {} and {} in {} motions; with 3 anchors and 1/2/3 "
                    "features {}. The second vector lies in the null space without anchors: {}",
                    three.left(1), four.left(1), motions, joined(by_features), yes_no(without)},
       .number = number_of("dimension of N(Q_1) with three anchors, of 12", three.left(1)),
       .why = "it has one dimension, the distance of the feature, [0 0 0 r] with r in axes of the world"},
      both(vectors_4_38), in_truth(both(named({"depth"}))));
}

std::vector<Claim> three_or_more_anchors() {
  const Study &three = with_anchors(3), &at_once = of_one_segment(world(1, 3));
  const auto by_Q_1 = three.observable(1), along = at_once.observable_along();
  Cases cases;
  for (const int anchors : {3, 4})
    for (const int features : {1, 2, 3}) {
      const Study& s = with_anchors(anchors, features);
      cases.add({{"{} and {}: {}", anchors, features, s.segments_text()}, full_in_two(s)});
    }
  return {
      studied(2, "4.2-anchored-recovered", "below (4.38)",
              "With three or more anchors one segment recovers linear velocities only",
              {.rule = Rule::dimension,
               .measured = {"states outside the null space with 3 anchors in {} motions: of Q_1 {}; of one "
                            "segment of the motion itself {}",
                            motions, listed(by_Q_1), listed(along)},
               .number = left_in_truth(at_once, " of one segment, with three anchors"),
               .why = "one segment recovers all states: the feature by the way that is driven in it, which "
                      "Q_1 leaves, and those of the vehicle, as in Q_1"},
              InTruth{along == velocities, in_truth(fully_observable(at_once))},
              ByMethod{by_Q_1 == velocities, in_truth(by_Q_1 == of_vehicle)}),
      studied(
          6, "4.2-anchored-two-segments", "below (4.38)",
          "With three or more anchors the SOM has full rank in two segments",
          {.rule = Rule::dimension,
           .measured = {"dimensions left by SOM and TOM after 1/2/3 segments, anchors and features: {}",
                        cases.text()},
           .number = number_of("dimensions left by the SOM of two segments, three anchors and one feature",
                               three.left(2))},
          cases.hold())};
}

/// By the method, in one segment and in two: how many dimensions are left, and the states that are recovered.
struct Recovery {
  std::vector<int> left;
  std::vector<std::string> at_once, then;

  explicit Recovery(const Study& s)
      : left{s.left(1), s.left(2)}, at_once(s.observable(1)), then(s.observable(2)) {}

  bool as_printed() const {
    return left == std::vector{4, 1} && at_once == velocities && then == velocities_and_feature;
  }
  bool all_of_vehicle_at_once() const { return left == std::vector{1, 0} && at_once == of_vehicle; }
};

Claim anchored_unaccelerated() {
  const Case three = world(1, 3), falling = unaccelerated(three, Unaccelerated::falls),
             floating = unaccelerated(three, Unaccelerated::weightless);
  Studies all;
  const Recovery falls(all.add("falling", study(falling))),
      floats(all.add("without gravity", study(floating)));
  const Study &falls_once = of_one_segment(falling), &floats_once = of_one_segment(floating);
  const bool at_once_as_printed =
      falls_once.observable_along() == velocities && floats_once.observable_along() == velocities;
  const auto all_states = [](const Study& s) {
    return s.observable_along().size() == s.states().size() && fully_observable(s);
  };
  return studied(
      4, "4.2-anchored-unaccelerated", "below (4.38)",
      "Without acceleration (f = 0) three anchors leave four modes in one segment, which still recovers "
      "linear velocities, and one in two, which do not recover the vehicle's position and orientation",
      {.rule = Rule::dimension,
       .measured =
           {"{}. States outside N(Q_1): {}, and {}; one segment of the motion itself leaves {} and {}",
            all.text(), listed(falls.at_once), listed(floats.at_once), joined({falls_once.true_dimension()}),
            joined({floats_once.true_dimension()})},
       .number = left_in_truth(falls_once, " of one segment, falling"),
       .why = "nothing is left: three anchors determine all states, accelerated or not. Q_1 leaves the "
              "distance of the feature, and two segments nothing"},
      InTruth{falls_once.true_dimension() == 4 && floats_once.true_dimension() == 4 && at_once_as_printed,
              in_truth(all_states(falls_once) && all_states(floats_once))},
      ByMethod{falls.as_printed() && floats.as_printed(),
               in_truth(falls.all_of_vehicle_at_once() && floats.all_of_vehicle_at_once())});
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(example_4_2, settings,
                  {matrix_claims(), without_anchors(), few_anchors(), anchored_null_space(),
                   three_or_more_anchors(), anchored_unaccelerated(), relative_claims()});
}

}  // namespace
}  // namespace incognita::observability_claims::inertial

const incognita::Experiment incognita::example_4_2{
    "4.2", "Bearings for a body with inertial sensors", {}, observability_claims::inertial::run};
