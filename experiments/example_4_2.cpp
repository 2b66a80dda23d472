// Example 4.2: observability of a body with inertial sensors and a camera, without and with anchors. Its
// matrices are in example_4_2_matrices.cpp, the relative map in example_4_2_relative.cpp.
//
// Experiment: the built-in systems `inertial` and `inertial-rb` (azimuth, elevation; and range), motions and
// rules of observability_claims.hpp; 1 to 3 features, up to 4 anchors, also two of them one above the other;
// also unaccelerated, in each of the ways that `f = 0` may mean: falling, without gravity, and (f = -g then)
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

const Study& with_anchors(int anchors, int features = 1) { return study(world(features, anchors)); }

std::vector<Claim> without_anchors() {
  const Study& s = study(world());
  const bool basis = for_all({2, 3}, [&](int k) { return s.stripped_spanned_by(k, named({"translation"})); });
  const auto in_som = s.observable(3), along = s.observable_along();
  const std::vector<std::string> printed{"vx", "vy", "vz", "phi", "theta", "psi"}, ours{"vz", "phi", "theta"};
  const bool yaws = s.along_contains(named({"rotation about z"}));
  const Studies with_ranges = by_features({1, 2}, {.system = "inertial-rb"});
  return {
      studied("4.2-world-null-space", "(4.35)",
              "Null space of the SOM: the three translations of vehicle and feature",
              {.printed = "dimension 3",
               .measured = {"{}, in {} motions; the printed vectors span that of two and three segments: {}. "
                            "The state has {} entries; printed are vectors of 14",
                            s.text(), motions, yes_no(basis), s.error_states().size()}},
              basis),
      studied(
          "4.2-world-recovered", "below (4.35)",
          "Not fully observable: linear velocity and misalignments are recovered, and nothing else",
          {.printed = "velocity, misalignments",
           .measured = {"states outside the null space in {} motions: of the SOM {}; of the motion itself {}",
                        motions, listed(in_som), listed(along)},
           .why =
               "of both only what gravity determines: vertical speed, roll and pitch. Turning all about a "
               "vertical changes no measurement, so that heading and horizontal velocity are not recovered"},
          along == printed, along == ours && yaws && s.true_dimension() == 4),
      studied(with_ranges.cases(), "4.2-range-bearing-world", "below (4.28), of [19]",
              "With range and bearing the world-centric map is partially observable",
              {.printed = "partially", .measured = with_ranges.text()}, with_ranges.all(remains_partial))};
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
  const bool but_the_yaw = one.along_spanned_by(about_anchor({"rotation about z"})) && one.full_rank(2);
  return studied(anchored.cases(), "4.2-few-anchors", "head of Section 4.1.2, below (4.37)",
                 "One or two anchors leave the system partially observable; it takes more than two",
                 {.printed = "partially",
                  .measured = anchored.text(),
                  .why = "one does: the turn about the vertical through it is left, which is not in the null "
                         "spaces of SOM and TOM. Two are enough, unless one is above the other"},
                 one.true_dimension() > 0 && two.true_dimension() > 0,
                 but_the_yaw && fully_observable(two) && vertical.true_dimension() == 1);
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
      "Null space of one segment with three or more anchors and one feature",
      {.printed = "[0 0 0 C r], [r x f 0 f 0]: dimension 2",
       .measured = {"dimension with 3 and 4 anchors {} and {} in {} motions; with 3 anchors and 1/2/3 "
                    "features {}. The second vector lies in the null space without anchors: {}",
                    three.left(1), four.left(1), motions, joined(by_features), yes_no(without)},
       .why = "1: the distance of the feature, [0 0 0 r] with r in axes of the world"},
      both(vectors_4_38), both(named({"depth"})));
}

std::vector<Claim> three_or_more_anchors() {
  const Study& three = with_anchors(3);
  const auto seen = three.observable(1);
  Cases cases;
  for (const int anchors : {3, 4})
    for (const int features : {1, 2, 3}) {
      const Study& s = with_anchors(anchors, features);
      cases.add({{"{} and {}: {}", anchors, features, s.segments_text()}, s.left(2) == 0});
    }
  return {
      studied("4.2-anchored-recovered", "below (4.38)",
              "With three or more anchors one segment recovers linear velocities only",
              {.printed = "velocities",
               .measured = {"states outside N(Q_1) with 3 anchors in {} motions: {}", motions, listed(seen)},
               .why = "all states of the vehicle"},
              seen == velocities, seen == of_vehicle && fully_observable(three)),
      studied(6, "4.2-anchored-two-segments", "below (4.38)",
              "With three or more anchors the SOM has full rank in two segments",
              {.printed = "0",
               .measured = {"dimensions left by SOM and TOM after 1/2/3 segments, anchors and features: {}; "
                            "by the motion itself, 3 and 1: {}",
                            cases.text(), three.true_dimension()}},
              fully_observable(three) && cases.hold())};
}

/// In one segment and in two: how many dimensions are left, and the states that are recovered.
struct Recovery {
  std::vector<int> left;
  std::vector<std::string> at_once, then;

  explicit Recovery(const Study& s)
      : left{s.left(1), s.left(2)}, at_once(s.observable(1)), then(s.observable(2)) {}

  bool as_printed() const {
    return left == std::vector{4, 1} && at_once == velocities && then == velocities_and_feature;
  }
  bool all_of_vehicle_at_once() const { return left == std::vector{1, 0} && at_once == of_vehicle; }
  std::string text() const { return fmt::format("{} ({} in one)", joined(left), listed(at_once)); }
};

Claim anchored_unaccelerated() {
  const Case three = world(1, 3);
  Studies all;
  const Recovery falling(all.add("falling", study(unaccelerated(three, Unaccelerated::falls)))),
      floating(all.add("without gravity", study(unaccelerated(three, Unaccelerated::weightless)))),
      accelerated(all.add("accelerated", study(three)));
  const auto in_truth = all.each([](const Study& s) { return s.true_dimension(); });
  const bool ours = falling.all_of_vehicle_at_once() && floating.all_of_vehicle_at_once() &&
                    accelerated.all_of_vehicle_at_once();
  return studied(
      all.cases(), "4.2-anchored-unaccelerated", "below (4.38)",
      "Without acceleration (f = 0) three anchors leave four in one segment, which still recovers linear "
      "velocities, and one in two, which recover the feature's position and the velocity, but not the "
      "vehicle's position and orientation",
      {.printed = "4, then 1",
       .measured = {"dimensions left by the SOM after 1/2 segments with 3 anchors (and states outside its "
                    "null space): falling {}; without gravity {}; accelerated {}. By the motion itself {}",
                    falling.text(), floating.text(), accelerated.text(), joined(in_truth)},
       .why = "1, then 0: three anchors determine all states of the vehicle at once, accelerated or not"},
      falling.as_printed() && floating.as_printed() && in_truth == std::vector{0, 0, 0},
      ours && in_truth == std::vector{0, 0, 0});
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
