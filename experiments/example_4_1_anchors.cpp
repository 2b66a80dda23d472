// Example 4.1 with anchors: how many it takes to observe a planar vehicle with a camera.
//
// Experiment: the built-in systems `planar` and `planar-rb` (ranges and bearings), motions and rules of
// observability_claims.hpp; up to 3 anchors.
#include "experiments/common.hpp"
#include "experiments/example_4_1.hpp"

namespace incognita::observability_claims::planar {

namespace {

Claim anchored_h() {
  Worst worst;
  for (const Course& course : world(1, 2).courses())
    for (int i = 0; i < 2; ++i) {
      const Vector2d b = course.points[0].anchors.segment<2>(2 * i) - course.points[0].x.head<2>();
      const double da = b.squaredNorm();
      const auto row = [&](double over) { return five(b.y() / over, -b.x() / over, -1, 0, 0); };
      worst.take(row(da * da), row(da), course.exact[0].H.row(1 + i).transpose());
    }
  return studied("4.1-anchored-H", "(4.21)", "Rows of H for anchors are the derivatives of (4.12), to 1e-9",
                 {.printed = "divided by da^2, da = (a_y - y)^2 + (a_x - x)^2",
                  .measured = {"largest difference in {} motions: {}", motions, worst.text()},
                  .why = "da is the square already"},
                 worst, rounding);
}

std::vector<Claim> with_two_anchors() {
  const Study& s = world(1, 2);
  const bool basis = s.stripped_spanned_by(1, named({"depth"}));
  return {
      studied("4.1-anchored-null-space", "(4.22)",
              "Null space of one segment with two anchors: the distance of the feature",
              {.printed = "dimension 1",
               .measured = {"dimension {} of 5 in {} motions; the printed vector spans it: {}", s.left(1),
                            motions, yes_no(basis)}},
              basis),
      studied("4.1-anchored-two-segments", "below (4.22)",
              "With two anchors vehicle and feature are completely observable in two segments",
              {.printed = "0", .measured = {"{}, in {} motions", s.text(), motions}}, observable_in_two(s))};
}

Claim anchored_total() {
  bool stays = true;
  const Cases full = by_number({1, 2, 3}, [&](int anchors) -> CaseResult {
    const Study& s = world(1, anchors);
    stays = stays && s.stays();
    return {joined(s.total_dimensions()), dimension(s.total(2)) == 0};
  });
  return studied(
      3, "4.1-anchored-total", "below (4.22)",
      "N(Q_j) is within N(F_j), and the TOM has full rank in two segments, for one or more anchors",
      {.printed = "0",
       .measured =
           {"(4.9) holds in {} segments; dimensions left by the TOM after 1/2/3 segments, by anchors: {}",
            stays ? "all" : "not all", full.text()}},
      stays && full.hold());
}

/// SOM and TOM fall short in one segment, and in two they do not.
bool full_in_two(const Study& s) { return s.rank_deficient(1) && s.full_rank(2); }

/// Of the linear analysis, so it is SOM and TOM that decide; the motion itself is shown beside them.
std::vector<Claim> linear_analysis() {
  const Studies all = by_anchors({0, 1, 2, 3}, {.system = "planar"}),
                one_and_two = by_anchors({1, 2}, {.system = "planar"});
  const Study &one = world(1, 1), &two = world(1, 2), &at_once = world(1, 2, 1);
  const bool one_does = full_in_two(one) && world(1, 0).rank_deficient(3),
             always_two = full_in_two(two) && full_in_two(world(1, 3)),
             in_truth_two_and_one = one.true_dimension() > 0 && fully_observable(at_once);
  return {
      studied(5, "4.1-anchors-needed", "above (4.21)",
              "For the linear analysis two anchors and two time segments are needed for full observability",
              {.printed = "two and two",
               .measured = {"{}. The motion itself leaves {} in one segment with two", all.text(),
                            joined({at_once.true_dimension()})},
               .why = "two segments, but one anchor: by SOM and TOM, and by the next sentence of the text. "
                      "For the motion itself it is two anchors and one segment"},
              full_in_two(two) && one.rank_deficient(3), one_does && always_two && in_truth_two_and_one),
      studied(
          2, "4.1-one-anchor-twice", "above (4.21)",
          "One anchor measured from two different steps is equivalent to two anchors",
          {.printed = "equivalent",
           .measured = {"{}. What one leaves is the turn about it: {}", one_and_two.text(),
                        yes_no(one.along_spanned_by(about_anchor({"rotation"})))},
           .why = "so it is by SOM and TOM. Turning vehicle and map about the anchor changes no measurement"},
          one.true_dimension() == two.true_dimension() && one.left(2) == two.left(2))};
}

Claim range_and_bearing() {
  const auto with = [](int anchors, int segments = 3) -> const Study& {
    return study({.system = "planar-rb", .anchors = anchors, .segments = segments});
  };
  const Studies all = by_anchors({0, 1, 2}, {.system = "planar-rb"});
  const Study &one = with(1), &at_once = with(2, 1);
  const bool in_truth = one.true_dimension() > 0 && at_once.true_dimension() == 0,
             by_matrices = one.rank_deficient(3) && at_once.full_rank(1),
             one_does = with(0).rank_deficient(3) && one.full_rank(1) && at_once.full_rank(1);
  return studied(
      4, "4.1-range-bearing", "above (4.21), of [3, 85]",
      "With range and bearing one segment and two anchors are needed",
      {.printed = "one and two",
       .measured = {"{}. The motion itself leaves {} in one segment with two", all.text(),
                    joined({at_once.true_dimension()})},
       .why = "so it is for the motion itself. For SOM and TOM one anchor in one segment is enough"},
      in_truth && by_matrices, in_truth && one_does);
}

Claim nonlinear_anchors() {
  Cases cases;
  for (const int features : {0, 1})
    for (const int anchors : {1, 2}) {
      const int d = dimension(lie({.system = "planar", .features = features, .anchors = anchors}));
      cases.add({{"{} and {}: {}", features, anchors, joined({d})}, d == (anchors == 1 ? 1 : 0)});
    }
  return studied(
      4, "4.1-nonlinear-anchors", "head of Chapter 4, above (4.21), of [11]",
      "By the nonlinear analysis absolute localization, with a map or without, takes two anchors",
      {.printed = "two",
       .measured = {"dimensions left by the Lie derivatives at {} points, features and anchors: {}", motions,
                    cases.text()}},
      cases.hold());
}

}  // namespace

std::vector<Claim> anchor_claims() {
  return concatenated({range_and_bearing(), nonlinear_anchors(), linear_analysis(), anchored_h(),
                       with_two_anchors(), anchored_total()});
}

}  // namespace incognita::observability_claims::planar
