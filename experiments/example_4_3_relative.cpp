// Example 4.3, relative map: features relative to the camera, in axes of the world.
//
// Experiment: the built-in system `planar-cv` in its relative form, motions and rules of
// observability_claims.hpp; 1 to 3 features; with H as it is and with the zero that is printed in its heading
// column; also at rest. The thesis prints matrices of r = p - x_f; ours is x_f - p.
#include "experiments/common.hpp"
#include "experiments/observability_claims.hpp"
#include "incognita/io/formats/system_file.hpp"

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

const Vectors turn_and_scale = named({"rotation", "scale"});

bool leaves_turn_and_scale(const Study& s) { return s.along_spanned_by(turn_and_scale); }
/// Why SOM and TOM do not leave them.
bool frozen_rows_see_both(const Study& s) { return seen_by_frozen_rows_only(s, turn_and_scale); }

Studies maps_of_three() { return by_features({1, 2, 3}, relative_map("planar-cv")); }

/// A row of H or H F in the printed order of states, with the printed sign of r.
Eigen::RowVectorXd as_printed(const Eigen::RowVectorXd& row) {
  return (Eigen::RowVectorXd(6) << -row.tail(2), row.head(4)).finished();
}

/// (4.50) against derivatives of the motion by the states: those of the program, and by central differences.
Claim error_dynamics() {
  const SymbolicSystem system = make_symbolic(load_system("planar-cv", "relative"));
  const SystemInstance instance(system, 1, 0);
  MatrixXd printed = MatrixXd::Zero(6, 6), to_printed(6, 6);
  printed(0, 3) = printed(1, 4) = printed(2, 5) = 1;
  for (int i = 0; i < 6; ++i) to_printed.row(i) = as_printed(VectorXd::Unit(6, i).transpose());
  to_printed.transposeInPlace();  // from our states to the printed ones, r = p - x_f
  const auto in_our_order = [&](const MatrixXd& F) -> MatrixXd {
    return to_printed.transpose() * F * to_printed;
  };
  const double of_program =
      largest(relative(), [&](const Course& c) { return apart(c.exact[0].F, in_our_order(printed)); });
  const double of_differences = largest(relative(), [&](const Course& c) {
    constexpr double h = 1e-3;
    MatrixXd F(6, 6);
    for (int i = 0; i < 6; ++i) {
      SystemPoint more = c.points[0], less = c.points[0];
      more.x[i] += h, less.x[i] -= h;
      F.col(i) = (instance.rate(more) - instance.rate(less)) / (2 * h);
    }
    return apart(F, in_our_order(printed));
  });
  return studied(
      "4.3-relative-F", "(4.49), (4.50)",
      "F of one feature relative to a vehicle of constant velocity on the plane is the derivative of its "
      "motion, the same at all states; to 1e-9",
      {.printed = "r' = v, theta' = omega, v' = 0, omega' = 0",
       .measured = {"largest difference at {} random states: from exact derivatives {}, from central "
                    "differences {}",
                    motions, below(of_program), below(of_differences)}},
      of_program < rounding && of_differences < rounding);
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
      {.printed = "[r_y/d^2 -r_x/d^2 0 0 0 0; 0 0 0 r_y/d^2 -r_x/d^2 0]",
       .measured = {"largest difference from exact derivatives in {} motions: {}", motions, worst.text()},
       .number = exactly("largest difference of the printed entries", worst.printed),
       .why = "-1 in the columns of heading and turn rate, as (4.24) has it (r is p - x_f here)"},
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
  const Study& once = study({.system = "planar-cv", .representation = "relative", .segments = 1});
  const auto by_Q_1 = s.observable(1), along = once.observable_along();
  return {
      studied("4.3-relative-null-space", "(4.52)", "The four vectors of (4.52) span the null space of Q_1",
              {.rule = Rule::dimension,
               .printed = "[r 0 0 0], [0 0 r 0], [0 0 1 0 0 0], [0 0 0 0 0 1]",
               .measured = {"dimension {} of 6 in {} motions; the printed vectors span it: {}; with the 0 of "
                            "(4.51): {}",
                            s.left(1), motions, yes_no(as_printed), yes_no(of_zero)},
               .number = number_of("dimension of N(Q_1), of 6", s.left(1)),
               .why = "heading and turn rate only together with the turned r: [-r_y r_x 1 0 0 0], [0 0 0 r_y "
                      "-r_x 1] with r = x_f - p. What is printed comes of the 0 in (4.51)"},
              as_printed, as_corrected(s.stripped_spanned_by(1, ours) && of_zero)),
      studied(
          2, "4.3-relative-instant", "below (4.52)",
          "No state is completely observable in one segment, not even the orientation; four modes are "
          "unobservable",
          {.rule = Rule::dimension,
           .measured = {"states outside the null space in {} motions: of Q_1, which leaves {}, {}; of one "
                        "segment of the motion itself, which leaves {}, {}",
                        motions, s.left(1), listed(by_Q_1), joined({once.true_dimension()}), listed(along)},
           .number = left_in_truth(once, " of one segment"),
           .why = "the turn rate is: two modes are left, turning all and scaling all"},
          InTruth{along.empty() && once.true_dimension() == 4,
                  in_truth(along == std::vector<std::string>{"wz"} && leaves_turn_and_scale(once))},
          ByMethod{by_Q_1.empty() && s.left(1) == 4})};
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
      {.rule = Rule::dimension,
       .measured = {"{}, in {} motions; with the 0 of (4.51) SOM leaves {}, by (4.53) {}; states outside the "
                    "null space of the motion itself: {}",
                    s.text(), motions, joined(dimensions_with_zero(s)), yes_no(of_zero), listed(seen)},
       .number = left_in_truth(s),
       .why = "two modes are left, but they are turning all and scaling all; the angular velocity is "
              "recovered. (4.53) comes of the 0 in (4.51); with -1 the SOM of three segments has full rank"},
      InTruth{s.along_spanned_by(printed),
              in_truth(leaves_turn_and_scale(s) && std::ranges::count(seen, "wz") > 0)},
      ByMethod{s.stripped_spanned_by(2, printed) && s.stripped_spanned_by(3, printed),
               in_truth(of_zero && third_takes_both)});
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
      "More features do not change that two modes are left, by the SOM of two segments or the motion itself",
      {.rule = Rule::dimension,
       .measured = {"{}; left by SOM with the 0 of (4.51): {}", maps.text(), zero.text()},
       .number = left_in_truth(relative(3), ", with three features"),
       .why = "a second feature removes one from the null space of the SOM, unless H has the 0 of (4.51)"},
      InTruth{maps.all(leaves_turn_and_scale)},
      ByMethod{left == std::vector{2, 2, 2}, in_truth(zero.hold() && left == std::vector{2, 1, 1})});
}

Claim must_move() {
  const Study &s = relative(), &rest = relative(1, "stationary");
  const auto seen = s.observable_along(), by_som = s.observable(3);
  const auto has_position = [](const std::vector<std::string>& states) {
    return std::ranges::count(states, "rx_1") > 0 && std::ranges::count(states, "ry_1") > 0;
  };
  const bool lost = rest.true_dimension() > s.true_dimension(),
             lost_by_som = rest.dimensions() == std::vector{4, 4, 4} && !has_position(rest.observable(3));
  return studied(
      2, "4.3-relative-moving", "below (4.53)",
      "The velocity must be nonzero to at least recover the relative positions: moving recovers them",
      {.rule = Rule::dimension,
       .measured = {"{}: moving {}, at rest {}; states outside the null space moving: of the SOM of three "
                    "segments {}; of the motion itself {}",
                    legend, s.numbers(), rest.numbers(), listed(by_som), listed(seen)},
       .number = left_in_truth(s, ", moving"),
       .why = "moving recovers more than resting, but not the relative positions, which are left to turn and "
              "to scale, with any number of features"},
      InTruth{lost && has_position(seen), in_truth(lost && maps_of_three().all(leaves_turn_and_scale))},
      ByMethod{lost_by_som && has_position(by_som)});
}

Claim never_fully_observable() {
  const Studies maps = maps_of_three();
  const auto full_unless_zero = [](const Study& s) {
    return s.full_rank(3) && dimensions_with_zero(s)[2] > 0;
  };
  const bool frozen = maps.all(frozen_rows_see_both);
  return studied(
      3, "4.3-relative-never", "end of Example 4.3",
      "No relative map of a constant-velocity model is fully observable, or reaches the rank condition",
      {.rule = Rule::dimension,
       .measured = {"{}. With the 0 of (4.51) SOM leaves some of three segments, with -1 nothing: {}; turn "
                    "and scale are seen only by H F, in which H is frozen: {}",
                    maps.text(), yes_no(maps.all(full_unless_zero)), yes_no(frozen)},
       .number = left_in_truth(relative())},
      InTruth{maps.all(leaves_turn_and_scale)},
      ByMethod{maps.all(never_full), in_truth(maps.all(full_unless_zero) && frozen)});
}

}  // namespace

std::vector<Claim> planar_cv_relative_claims() {
  return concatenated({error_dynamics(), first_segment(), one_segment(), more_segments(), more_features(),
                       must_move(), never_fully_observable()});
}

}  // namespace incognita::observability_claims
