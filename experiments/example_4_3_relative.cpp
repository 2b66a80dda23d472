// Example 4.3, relative map: features relative to the camera, in axes of the world.
//
// Experiment: the built-in system `planar-cv` in its relative form, motions and rules of
// observability_claims.hpp; 1 to 3 features; with H as it is and with the zero that is printed in its heading
// column; also at rest. The thesis prints matrices of r = p - x_f; ours is x_f - p.
#include "experiments/common.hpp"
#include "experiments/observability_claims.hpp"

namespace incognita::observability_claims {
namespace {

const Study& relative(int features = 1, const std::string& motion = "general") {
  return study(relative_map("planar-cv", features, motion));
}

Vector2d r_of(const SystemPoint& p) { return p.x.segment<2>(4); }

/// Our states of one feature in the printed order.
VectorXd six(double rx, double ry, double theta, double vx, double vy, double omega) {
  return (VectorXd(6) << theta, vx, vy, omega, rx, ry).finished();
}

const VectorXd heading = six(0, 0, 1, 0, 0, 0), turn_rate = six(0, 0, 0, 0, 0, 1);

void zero_heading(LinearizedSystem& form, const SystemPoint&) { form.H.col(0).setZero(); }

std::vector<int> dimensions_with_zero(const Study& s) {
  return each_of({1, 2, 3}, [&](int k) { return dimension(stripped_with(s, k, zero_heading)); });
}

bool leaves_turn_and_scale(const Study& s) { return s.along_spanned_by(named({"rotation", "scale"})); }

Studies maps_of_three() { return by_features({1, 2, 3}, relative_map("planar-cv")); }

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
  return studied(
      "4.3-relative-Q1", "(4.50), (4.51)", "Q_1 with H of (4.24), to 1e-9",
      {.printed = "0 in the columns of heading and turn rate",
       .measured = {"largest difference from exact derivatives in {} motions: {}", motions, worst.text()},
       .why = "-1 there, as (4.24) has it (r is p - x_f here)"},
      worst, rounding);
}

std::vector<Claim> one_segment() {
  const Study& s = relative();
  const auto printed = [](const Course& c) -> Basis {
    const Vector2d r = r_of(c.points[0]);
    return {six(r.x(), r.y(), 0, 0, 0, 0), six(0, 0, 0, r.x(), r.y(), 0), heading, turn_rate};
  };
  const auto ours = [&](const Course& c) {
    const Vector2d r = r_of(c.points[0]);
    Basis all = printed(c);
    all[2] += six(-r.y(), r.x(), 0, 0, 0, 0);
    all[3] += six(0, 0, 0, r.y(), -r.x(), 0);
    return all;
  };
  const bool of_zero = are_basis(stripped_with(s, 1, zero_heading), s.courses(), printed);
  const bool as_printed = s.stripped_spanned_by(1, printed);
  const auto seen = s.observable(1);
  return {
      studied(
          "4.3-relative-null-space", "(4.52)", "Null space of one segment",
          {.printed = "[r 0 0 0], [0 0 r 0], heading, turn rate: dimension 4",
           .measured =
               {"dimension {} of 6 in {} motions; the printed vectors span it: {}; with the 0 of (4.51): {}",
                s.left(1), motions, yes_no(as_printed), yes_no(of_zero)},
           .why = "dimension 4, but heading and turn rate only together with the turned r: [-r_y r_x 1 0 0 "
                  "0], [0 0 0 r_y -r_x 1] with r = x_f - p"},
          as_printed, s.stripped_spanned_by(1, ours)),
      studied(
          "4.3-relative-instant", "below (4.52)",
          "No state is completely observable in one segment, not even the orientation",
          {.printed = "none", .measured = {"states outside N(Q_1) in {} motions: {}", motions, listed(seen)}},
          seen.empty())};
}

Claim more_segments() {
  const Study& s = relative();
  const Vectors printed = always({heading, turn_rate});
  const bool third_takes_both = s.dimensions() == std::vector{4, 2, 0},
             of_zero = for_all({2, 3}, [&](int k) {
               return are_basis(stripped_with(s, k, zero_heading), s.courses(), printed);
             });
  const auto seen = s.observable_along();
  return studied(
      "4.3-relative-two-segments", "(4.53)",
      "Two or more segments leave two modes, orientation and angular velocity",
      {.printed = "heading, turn rate: dimension 2",
       .measured = {"{}, in {} motions; with the 0 of (4.51) SOM leaves {}, by (4.53) {}; states outside the "
                    "null space of the motion itself: {}",
                    s.text(), motions, joined(dimensions_with_zero(s)), yes_no(of_zero), listed(seen)},
       .why = "two modes are left, but they are turning all and scaling all; the angular velocity is "
              "recovered. (4.53) comes of the 0 in (4.51); with -1 the SOM of three segments has full rank"},
      s.stripped_spanned_by(2, printed) && s.stripped_spanned_by(3, printed) && s.along_spanned_by(printed),
      leaves_turn_and_scale(s) && std::ranges::count(seen, "wz") > 0 && of_zero && third_takes_both);
}

Claim more_features() {
  const Studies maps = maps_of_three();
  const Cases zero = by_number({1, 2, 3}, [](int features) -> CaseResult {
    const std::vector<int> left = dimensions_with_zero(relative(features));
    return {joined(left), left[1] == 2};
  });
  const auto left = maps.each([](const Study& s) { return s.left(2); });
  return studied(
      maps.cases(), "4.3-relative-features", "below (4.53)",
      "More features do not change that the SOM of two segments leaves two modes",
      {.printed = "2",
       .measured = {"{}; left by SOM with the 0 of (4.51): {}", maps.text(), zero.text()},
       .why = "of the motion itself that is true, which leaves turn and scale with any number. A second "
              "feature removes one from the null space of the SOM, unless H has the 0 of (4.51)"},
      left == std::vector{2, 2, 2},
      maps.all(leaves_turn_and_scale) && zero.hold() && left == std::vector{2, 1, 1});
}

Claim must_move() {
  const Study &s = relative(), &rest = relative(1, "stationary");
  const auto seen = s.observable_along();
  const bool recovered = std::ranges::count(seen, "rx_1") > 0 && std::ranges::count(seen, "ry_1") > 0;
  const bool lost = rest.true_dimension() > s.true_dimension() && rest.dimensions() == std::vector{4, 4, 4};
  return studied(
      2, "4.3-relative-moving", "below (4.53)",
      "The velocity must be nonzero to at least recover the relative positions",
      {.printed = "recovered",
       .measured = {"{}: moving {}, at rest {}; states outside the null space of the motion itself: {}",
                    legend, s.numbers(), rest.numbers(), listed(seen)},
       .why = "moving recovers them up to scale and turn, with any number of features"},
      lost && recovered, lost && maps_of_three().all(leaves_turn_and_scale));
}

Claim never_full() {
  const Studies maps = maps_of_three();
  const auto unless_zero = [](const Study& s) { return s.full_rank(3) && dimensions_with_zero(s)[2] > 0; };
  const Cases in_truth = by_number({1, 2, 3}, [](int features) -> CaseResult {
    const Study& s = relative(features);
    return {{"{}, with the 0 of (4.51) {}", s.numbers(), joined(dimensions_with_zero(s))},
            leaves_turn_and_scale(s)};
  });
  return studied(
      3, "4.3-relative-never", "end of Example 4.3",
      "No relative map of a constant-velocity model is fully observable, or reaches the rank condition",
      {.printed = "none",
       .measured = {"{}, by features: {}", legend, in_truth.text()},
       .why = "none is, as the motion itself leaves turn and scale. But SOM and TOM have full rank in three "
              "segments, unless H has the 0 of (4.51)"},
      in_truth.hold() && maps.all([](const Study& s) { return s.rank_deficient(3); }),
      in_truth.hold() && maps.all(unless_zero));
}

}  // namespace

std::vector<Claim> planar_cv_relative_claims() {
  return concatenated(
      {first_segment(), one_segment(), more_segments(), more_features(), must_move(), never_full()});
}

}  // namespace incognita::observability_claims
