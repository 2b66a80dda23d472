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
                 {.printed = "(a_y - y)/(da)^2, da = (a_y - y)^2 + (a_x - x)^2",
                  .measured = {"largest difference in {} motions: {}", motions, worst.text()},
                  .number = exactly("largest difference of the printed entries", worst.printed),
                  .why = "da is the square already"},
                 worst, rounding);
}

std::vector<Claim> with_two_anchors() {
  const Study& s = world(1, 2);
  const bool basis = s.stripped_spanned_by(1, named({"depth"}));
  return {studied("4.1-anchored-null-space", "(4.22)",
                  "With two anchors the distance of the feature spans the null space of Q_1",
                  {.rule = Rule::dimension,
                   .measured = {"dimension {} of 5 in {} motions; the printed vector spans it: {}", s.left(1),
                                motions, yes_no(basis)},
                   .number = number_of("dimension of N(Q_1) with two anchors, of 5", s.left(1))},
                  basis),
          studied("4.1-anchored-two-segments", "below (4.22)",
                  "With two anchors vehicle and feature are completely observable in two segments",
                  {.rule = Rule::dimension,
                   .measured = {"{}, in {} motions", s.text(), motions},
                   .number = left_in_truth(s, ", with two anchors")},
                  InTruth{fully_observable(world(1, 2, 2))}, ByMethod{full_in_two(s)})};
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
      {.rule = Rule::dimension,
       .measured =
           {"(4.9) holds in {} segments; dimensions left by the TOM after 1/2/3 segments, by anchors: {}",
            stays ? "all" : "not all", full.text()},
       .number = number_of("dimensions left by the TOM of two segments with one anchor",
                           dimension(world(1, 1).total(2)))},
      stays && full.hold());
}

/// SOM and TOM fall short in one segment, and in two they do not.
bool takes_two(const Study& s) { return s.rank_deficient(1) && s.full_rank(2); }

/// The turn about the anchor, which the motion itself leaves and nothing but frozen rows sees.
bool leaves_the_turn_about_it(const Study& s) {
  const Vectors turn = about_anchor({"rotation"});
  return s.along_spanned_by(turn) && seen_by_frozen_rows_only(s, turn);
}

std::vector<Claim> linear_analysis() {
  const Studies all = by_anchors({0, 1, 2, 3}, {.system = "planar"}),
                one_and_two = by_anchors({1, 2}, {.system = "planar"});
  const Study &one = world(1, 1), &two = world(1, 2), &at_once = world(1, 2, 1);
  const bool one_does = takes_two(one) && never_full(world(1, 0)), turns = leaves_the_turn_about_it(one);
  return {
      studied(5, "4.1-anchors-needed", "above (4.21)",
              "Two anchors and two time segments are needed for the system to become fully observable",
              {.rule = Rule::dimension,
               .measured = {"{}. The motion itself leaves {} in one segment with two anchors", all.text(),
                            joined({at_once.true_dimension()})},
               .number = left_in_truth(at_once, " of one segment, with two anchors"),
               .why = "two anchors, but one segment. By SOM and TOM it is two segments, but one anchor, as "
                      "the next sentence of the text has it"},
              InTruth{partially_observable(one) && fully_observable(two) && partially_observable(at_once),
                      in_truth(partially_observable(one) && fully_observable(at_once))},
              ByMethod{takes_two(two) && never_full(one),
                       in_truth(one_does && takes_two(two) && takes_two(world(1, 3)))}),
      studied(2, "4.1-one-anchor-twice", "above (4.21)",
              "One anchor measured from two different steps is equivalent to two anchors",
              {.rule = Rule::dimension,
               .measured = {"{}. What one leaves is the turn about it, and only H F sees it: {}",
                            one_and_two.text(), yes_no(turns)},
               .number = left_in_truth(one, ", with one anchor"),
               .why = "turning vehicle and map about the anchor changes no measurement; two anchors leave "
                      "nothing. By SOM and TOM one does, because H is frozen"},
              InTruth{one.true_dimension() == two.true_dimension(), in_truth(turns && fully_observable(two))},
              ByMethod{full_in_two(one) && full_in_two(two)})};
}

Claim range_and_bearing() {
  const auto with = [](int anchors, int segments = 3) -> const Study& {
    return study({.system = "planar-rb", .anchors = anchors, .segments = segments});
  };
  const Studies all = by_anchors({0, 1, 2}, {.system = "planar-rb"});
  const Study &one = with(1), &at_once = with(2, 1);
  return studied(
      4, "4.1-range-bearing", "above (4.21), of [3, 85]",
      "With range and bearing one segment and two anchors are needed",
      {.rule = Rule::dimension,
       .measured = {"{}. The motion itself leaves {} in one segment with two. For SOM and TOM one anchor in "
                    "one segment is enough: {}",
                    all.text(), joined({at_once.true_dimension()}), yes_no(one.full_rank(1))},
       .number = left_in_truth(one, ", with one anchor")},
      InTruth{partially_observable(one) && fully_observable(at_once)},
      ByMethod{never_full(one) && at_once.full_rank(1),
               in_truth(never_full(with(0)) && one.full_rank(1) && at_once.full_rank(1))});
}

Claim nonlinear_anchors() {
  Cases by_lie;
  bool som_needs_two = true, one_does = true;
  for (const int features : {0, 1})
    for (const int anchors : {1, 2}) {
      const Case which{.system = "planar", .features = features, .anchors = anchors};
      const int d = dimension(lie(which));
      by_lie.add({{"{} and {}: {}", features, anchors, joined({d})}, d == (anchors == 1 ? 1 : 0)});
      som_needs_two = som_needs_two && (anchors == 1 ? never_full(study(which)) : full_in_two(study(which)));
      one_does = one_does && full_in_two(study(which));
    }
  return studied(
      4, "4.1-nonlinear-anchors", "head of Chapter 4, above (4.21), of [11]",
      "Absolute localization, with a map or without, takes two anchors (by the nonlinear analysis)",
      {.rule = Rule::dimension,
       .measured = {"dimensions left by the Lie derivatives at {} points, features and anchors: {}. SOM and "
                    "TOM of two segments have full rank in all four: {}",
                    motions, by_lie.text(), yes_no(one_does)},
       .number = number_of("dimensions left by the Lie derivatives, with one feature and one anchor",
                           dimension(lie({.system = "planar", .anchors = 1})))},
      InTruth{by_lie.hold()}, ByMethod{som_needs_two, in_truth(one_does)});
}

}  // namespace

std::vector<Claim> anchor_claims() {
  return concatenated({range_and_bearing(), nonlinear_anchors(), linear_analysis(), anchored_h(),
                       with_two_anchors(), anchored_total()});
}

}  // namespace incognita::observability_claims::planar
