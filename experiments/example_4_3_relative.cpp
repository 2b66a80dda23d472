// Example 4.3, relative map: features relative to the camera, in axes of the world.
//
// Experiment: the built-in system `planar-cv` in its relative form, motions and rules of
// observability_claims.hpp; 1 to 3 features; with H as it is and with the zero that is printed in its heading
// column; also at rest. The thesis prints matrices of r = p - x_f; ours is x_f - p.
#include "experiments/chapter_4_parts.hpp"
#include "experiments/common.hpp"

namespace incognita::observability_claims::planar_cv {
namespace {

const Study& relative(int features = 1, const std::string& motion = "general") {
  return study({.system = "planar-cv", .representation = "relative", .features = features, .motion = motion});
}

Vector2d r_of(const SystemPoint& p) { return p.x.segment<2>(4); }

/// Our states of one feature in the printed order.
VectorXd six(double rx, double ry, double theta, double vx, double vy, double omega) {
  return (VectorXd(6) << theta, vx, vy, omega, rx, ry).finished();
}

void zero_heading(LinearizedSystem& form, const SystemPoint&) { form.H.col(0).setZero(); }

/// What SOM leaves with the printed zero.
std::vector<int> dimensions_with_zero(const Study& s) {
  return each_of({1, 2, 3}, [&](int k) { return dimension(stripped_with(s, k, zero_heading)); });
}

const Vectors turn_and_scale = named({"rotation", "scale"});

bool leaves_turn_and_scale(int features) { return relative(features).along_spanned_by(turn_and_scale); }

/// A row of H or H F in the printed order of states, with the printed sign of r.
Eigen::RowVectorXd as_printed(const Eigen::RowVectorXd& row) {
  return (Eigen::RowVectorXd(6) << -row.tail(2), row.head(4)).finished();
}

Claim first_segment() {
  Worst worst;
  for (const Course& course : relative().courses()) {
    const Vector2d r = r_of(course.points[0]);
    const MatrixXd& H = course.exact[0].H;
    MatrixXd exact(2, 6), printed = MatrixXd::Zero(2, 6);
    exact << as_printed(H), as_printed(H * course.exact[0].F);
    printed(0, 0) = printed(1, 3) = r.y() / r.squaredNorm();
    printed(0, 1) = printed(1, 4) = -r.x() / r.squaredNorm();
    MatrixXd ours = printed;
    ours(0, 2) = ours(1, 5) = -1;
    worst.take(printed, ours, exact);
  }
  return studied("4.3-relative-Q1", "(4.50), (4.51)", "Q_1 with H of (4.24), to 1e-9",
                 {.printed = "0 in the columns of heading and turn rate",
                  .measured = fmt::format("largest difference from exact derivatives in {} motions: {}",
                                          motions, worst.text()),
                  .why = "-1 there, as (4.24) has it (r is p - x_f here)"},
                 worst, rounding);
}

Claim instant_null_space() {
  const Study& s = relative();
  const auto distance = [](const Course& c) -> Basis {
    const Vector2d r = r_of(c.points[0]);
    return {six(r.x(), r.y(), 0, 0, 0, 0), six(0, 0, 0, r.x(), r.y(), 0)};
  };
  const auto printed = [&](const Course& c) {
    Basis all = distance(c);
    all.insert(all.end(), {six(0, 0, 1, 0, 0, 0), six(0, 0, 0, 0, 0, 1)});
    return all;
  };
  const auto ours = [&](const Course& c) {
    const Vector2d r = r_of(c.points[0]);
    Basis all = distance(c);
    all.insert(all.end(), {six(-r.y(), r.x(), 1, 0, 0, 0), six(0, 0, 0, r.y(), -r.x(), 1)});
    return all;
  };
  const bool of_zero = are_basis(stripped_with(s, 1, zero_heading), s.courses(), printed);
  return studied(
      "4.3-relative-null-space", "(4.52)", "Null space of one segment",
      {.printed = "[r 0 0 0], [0 0 r 0], heading, turn rate: dimension 4",
       .measured = fmt::format(
           "dimension {} of 6 in {} motions; the printed vectors span it: {}; with the 0 of (4.51): {}",
           s.left(1), motions, yes_no(s.stripped_spanned_by(1, printed)), yes_no(of_zero)),
       .why = "dimension 4, but heading and turn rate only together with the turned r: [-r_y r_x 1 0 0 0], "
              "[0 0 0 r_y -r_x 1] with r = x_f - p"},
      s.stripped_spanned_by(1, printed), s.stripped_spanned_by(1, ours));
}

Claim nothing_in_one_segment() {
  const auto seen = relative().observable(1);
  return studied("4.3-relative-instant", "below (4.52)",
                 "No state is completely observable in one segment, not even the orientation",
                 {.printed = "none",
                  .measured = fmt::format("states outside N(Q_1) in {} motions: {}", motions, listed(seen))},
                 seen.empty());
}

Claim more_segments() {
  const Study& s = relative();
  const Vectors printed = always({six(0, 0, 1, 0, 0, 0), six(0, 0, 0, 0, 0, 1)});
  const bool of_zero = are_basis(stripped_with(s, 2, zero_heading), s.courses(), printed) &&
                       are_basis(stripped_with(s, 3, zero_heading), s.courses(), printed),
             third_takes_both = s.dimensions() == std::vector{4, 2, 0};
  const auto seen = s.observable_along();
  const bool turn_rate = std::ranges::find(seen, "wz") != seen.end();
  return studied(
      "4.3-relative-two-segments", "(4.53)",
      "Two or more segments leave two modes, orientation and angular velocity",
      {.printed = "heading, turn rate: dimension 2",
       .measured =
           fmt::format("{}, in {} motions; with the 0 of (4.51) SOM leaves {}, by (4.53) {}; states outside "
                       "the null space of the motion itself: {}",
                       s.text(), motions, joined(dimensions_with_zero(s)), yes_no(of_zero), listed(seen)),
       .why = "two modes are left, but they are turning all and scaling all; the angular velocity is "
              "recovered. (4.53) comes of the 0 in (4.51); with -1 the SOM of three segments has full rank"},
      s.stripped_spanned_by(2, printed) && s.stripped_spanned_by(3, printed) && s.along_spanned_by(printed),
      leaves_turn_and_scale(1) && turn_rate && of_zero && third_takes_both);
}

Claim more_features() {
  bool corrected = true;
  Cases zero;
  const Cases printed = by_number({1, 2, 3}, [&](int features) -> CaseResult {
    const Study& s = relative(features);
    const std::vector<int> with_zero = dimensions_with_zero(s);
    zero.add({fmt::format("{}: {}", features, joined(with_zero))});
    corrected = corrected && leaves_turn_and_scale(features) && with_zero[1] == 2 &&
                s.left(2) == (features == 1 ? 2 : 1);
    return {s.numbers(), s.left(2) == 2};
  });
  return studied(
      "4.3-relative-features", "below (4.53)",
      "More features do not change that the SOM of two segments leaves two modes",
      {.printed = "2",
       .measured = fmt::format("{}, by features: {}; left by SOM with the 0 of (4.51): {}", legend,
                               printed.text(), zero.text()),
       .why = "of the motion itself that is true, which leaves turn and scale with any number. A second "
              "feature removes one from the null space of the SOM, unless H has the 0 of (4.51)",
       .runs = 3 * motions},
      printed.hold(), corrected);
}

Claim must_move() {
  const Study &s = relative(), &rest = relative(1, "stationary");
  const auto seen = s.observable_along();
  const auto has = [&](const char* name) { return std::ranges::find(seen, name) != seen.end(); };
  const bool lost = rest.true_dimension() > s.true_dimension() && rest.dimensions() == std::vector{4, 4, 4};
  return studied("4.3-relative-moving", "below (4.53)",
                 "The velocity must be nonzero to at least recover the relative positions",
                 {.printed = "recovered",
                  .measured = fmt::format(
                      "{}: moving {}, at rest {}; states outside the null space of the motion itself: {}",
                      legend, s.numbers(), rest.numbers(), listed(seen)),
                  .why = "moving recovers them up to scale and turn, with any number of features",
                  .runs = 2 * motions},
                 lost && has("rx_1") && has("ry_1"), lost && for_all({1, 2, 3}, leaves_turn_and_scale));
}

Claim never_full() {
  bool by_matrices = true, reached = true, with_zero = true;
  const Cases in_truth = by_number({1, 2, 3}, [&](int features) -> CaseResult {
    const Study& s = relative(features);
    by_matrices = by_matrices && s.rank_deficient(3);
    reached = reached && s.full_rank(3);
    with_zero = with_zero && dimensions_with_zero(s)[2] > 0;
    return {fmt::format("{}, with the 0 of (4.51) {}", s.numbers(), joined(dimensions_with_zero(s))),
            leaves_turn_and_scale(features)};
  });
  return studied(
      "4.3-relative-never", "end of Example 4.3",
      "No relative map of a constant-velocity model is fully observable, or reaches the rank condition",
      {.printed = "none",
       .measured = fmt::format("{}, by features: {}", legend, in_truth.text()),
       .why = "none is, as the motion itself leaves turn and scale. But SOM and TOM have full rank in three "
              "segments, unless H has the 0 of (4.51)",
       .runs = 3 * motions},
      in_truth.hold() && by_matrices, in_truth.hold() && reached && with_zero);
}

}  // namespace

std::vector<Claim> relative_claims() {
  return {first_segment(), instant_null_space(), nothing_in_one_segment(), more_segments(), more_features(),
          must_move(),     never_full()};
}

}  // namespace incognita::observability_claims::planar_cv
