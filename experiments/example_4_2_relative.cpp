// Example 4.2, relative map: features relative to the vehicle, in axes of the world.
//
// Experiment: the built-in systems `inertial` and `inertial-rb` in their relative forms, motions and rules of
// observability_claims.hpp; also unaccelerated, as in example_4_2.cpp. Printed vectors hold r, v, psi in this
// order; r is x_f - p, as (4.39) has it. Matrices are compared with exact derivatives by misalignments, as in
// example_4_2_matrices.cpp, to 1e-9; printed [x a] may be [a x] or its negative, r and f in axes of the world
// or of the sensor, whichever comes nearest.
#include "experiments/common.hpp"
#include "experiments/example_4_2.hpp"

namespace incognita::observability_claims::inertial {
namespace {

VectorXd nine(const Vector3d& r, const Vector3d& v, const Vector3d& psi) {
  return (VectorXd(9) << v, psi, r).finished();
}

/// The turn about a vertical, which the motion itself leaves and nothing but frozen rows sees.
bool leaves_the_yaw(const Study& s) {
  const Vectors turn = named({"rotation about z"});
  return s.along_spanned_by(turn) && seen_by_frozen_rows_only(s, turn);
}

/// dz/dr^s C [of_r I 0 [r x] of_psi], against exact derivatives.
double wrong_rows(double of_r, double of_psi) {
  return largest(study(relative()), [&](const Course& course) {
    const Begin b(course);
    const Matrix3d I = Matrix3d::Identity(), O = Matrix3d::Zero();
    return apart(b.A * b.C * beside({O, of_psi * cross(b.r), of_r * I}), b.exact.H);
  });
}

Claim measurement_matrix() {
  const Worst worst{std::min(wrong_rows(-1, 1), wrong_rows(-1, -1)), wrong_rows(1, 1)};
  return studied(
      "4.2-relative-H", "(4.39), (4.40)",
      "The measurement is [-I 0 [x r]] of features parametrized by r = x_f - p, to 1e-9 (before it dz/dr^s "
      "C)",
      {.printed = "[-I 0 [x r]]",
       .measured = {"largest difference from exact derivatives in {} motions, either sign of [x r]: {}",
                    motions, worst.text()},
       .number = exactly("largest difference of the printed entries, by their best reading", worst.printed),
       .why = "[I 0 [r x]]: I, as (4.41) has it, for r = x_f - p; -I is for p - x_f"},
      worst, rounding);
}

/// Rows of (4.41), with A for dz/dr^s, in the order of our states.
MatrixXd rows_4_41(const Matrix23& A, const Matrix3d& by_r, double of_v, const Matrix3d& by_f) {
  const Matrix23 O = Matrix23::Zero();
  MatrixXd rows(6, 9);
  rows << beside({O, A * by_r, A}), beside({of_v * A, O, O}), beside({O, A * by_f, O});
  return rows;
}

MatrixXd exact_rows(const Begin& b) {
  const MatrixXd HF = b.exact.H * b.exact.F;
  MatrixXd rows(6, 9);
  rows << b.exact.H, HF, HF * b.exact.F;
  return rows;
}

/// (4.41) by one reading: whether C stands behind dz/dr^s, r and f in axes of the sensor, the sign of [x a].
double wrong_4_41(bool turned, bool of_sensor, double sign, double of_v) {
  return largest(study(relative()), [&](const Course& course) {
    const Begin b(course);
    const Matrix23 A = turned ? Matrix23(b.A * b.C) : b.A;
    const auto by = [&](const Vector3d& a) -> Matrix3d {
      return sign * cross(of_sensor ? Vector3d(b.C * a) : a);
    };
    return apart(rows_4_41(A, by(b.r), of_v, by(b.f)), exact_rows(b));
  });
}

/// Of (4.42), with `directed` for what is printed as C r.
Basis vectors_4_42(const Course& c, bool directed_as_printed) {
  const Begin b(c);
  const Vector3d zero = Vector3d::Zero(), along = directed_as_printed ? Vector3d(b.C * b.r) : b.r;
  Vector3d zeta = -b.r.cross(b.f);
  zeta -= zeta.y() / along.y() * along;  // a multiple of the first puts the zero where it is printed
  return {nine(along, zero, zero), nine(zeta, zero, b.f), nine(zero, along, zero)};
}

Claim entries() {
  std::vector<double> readings;
  for (const bool of_sensor : {false, true})
    for (const double sign : {1.0, -1.0}) readings.push_back(wrong_4_41(false, of_sensor, sign, 1));
  const double printed = std::ranges::min(readings), corrected = wrong_4_41(true, false, 1, -1),
               without_minus = wrong_4_41(true, false, 1, 1),
               third = largest(study(relative()), [](const Course&course) {
                 const auto [F, H] = Begin(course).exact;
                 return (H * F * F * F).cwiseAbs().maxCoeff();
               });
  const Spaces of_printed = null_spaces(study(relative()), [](const Course& course) {
    const Begin b(course);
    return rows_4_41(b.A, cross(b.r), 1, cross(b.f));
  });
  const bool explains = are_basis(of_printed, study(relative()).courses(),
                                  [](const Course& c) { return vectors_4_42(c, true); });
  return studied(
      "4.2-relative-Q1-entries", "(4.41)",
      "Q_1 is H, H F and H F F with these entries, and nothing more, to 1e-9",
      {.printed = "[dz/dr^s 0 dz/dr^s x r], [0 dz/dr^s 0], [0 0 dz/dr^s x f]",
       .measured =
           {"largest difference from exact derivatives in {} motions: printed {:.2g}, with A C for A {:.2g}, "
            "ours {}; H F F F is {}. The null space of the printed rows is that of (4.42) with C r: {}",
            motions, printed, without_minus, below(corrected), below(third), yes_no(explains)},
       .number = exactly("largest difference of the printed entries, by their best reading", printed),
       .why =
           "with A = dz/dr^s: A C for A, -A C in the row of v (r' = -v), r and f in axes of the world. C is why (4.42) has "
           "C r for r"},
      printed < rounding && third < rounding,
      as_corrected(corrected < rounding && third < rounding && explains));
}

Claim null_space_of_one_segment() {
  const Study& s = study(relative());
  const auto basis = [&](bool as_printed) {
    return s.stripped_spanned_by(1, [&](const Course& c) { return vectors_4_42(c, as_printed); });
  };
  return studied("4.2-relative-null-space", "(4.42), (4.43)",
                 "The three vectors of (4.42), zeta of the form (4.43), span the null space of Q_1",
                 {.rule = Rule::dimension,
                  .printed = "[C r 0 0], [zeta 0 f], [0 C r 0]",
                  .measured = {"dimension {} of 9 in {} motions; spanned with C r: {}, with r: {}", s.left(1),
                               motions, yes_no(basis(true)), yes_no(basis(false))},
                  .number = number_of("dimension of N(Q_1), of 9", s.left(1)),
                  .why = "r in axes of the world, as f, in place of C r. zeta is r x f up to sign and "
                         "multiples of r, which put its zero along r_y as printed"},
                 basis(true), as_corrected(basis(false)));
}

/// In how many dimensions of three r, psi and v are left open.
struct LeftOpen {
  int r, psi, v;

  /// The states of the error form and of the equations are in the same order.
  explicit LeftOpen(const Spaces& spaces)
      : r(dimension_within(spaces, 6, 3)),
        psi(dimension_within(spaces, 3, 3)),
        v(dimension_within(spaces, 0, 3)) {}
  /// Of relative position and misalignment.
  bool partly() const { return (r == 1 || r == 2) && (psi == 1 || psi == 2); }
  std::string text() const {
    return fmt::format("{} of r, {} of psi, {} of v", joined({r}), joined({psi}), joined({v}));
  }
};

std::vector<Claim> one_segment() {
  const Study& s = study(relative());
  Case once = relative();
  once.segments = 1;
  const LeftOpen by_Q_1(s.stripped(1)), along(study(once).along());
  return {
      studied("4.2-relative-Q1", "(4.41)", "Q_1 has six independent rows",
              {.rule = Rule::dimension,
               .measured = {"rank {} of 9 in {} motions", 9 - s.left(1), motions},
               .number = exactly("rank of Q_1, of 9", 9 - s.left(1))},
              s.left(1) == 3),
      null_space_of_one_segment(),
      studied(2, "4.2-relative-partially", "below (4.43)",
              "Relative position and misalignment can only be partially reconstructed in one segment",
              {.rule = Rule::dimension,
               .measured = {"directions of three left open in {} motions: by N(Q_1) {}; by one segment of "
                            "the motion itself {}",
                            motions, by_Q_1.text(), along.text()},
               .number = left_in_truth(study(once), " of one segment")},
              InTruth{along.partly()}, ByMethod{by_Q_1.partly()})};
}

std::vector<Claim> two_segments() {
  const Study &s = study(relative()), &more = study(relative(2));
  const bool leaves = std::ranges::none_of(s.courses(), [](const Course& c) { return c.stays; });
  return {studied(2, "4.2-relative-two-segments", "(4.44)",
                  "SOM and TOM have full rank in two segments, although N(Q_j) is not within N(F_j)",
                  {.rule = Rule::dimension,
                   .measured = {"{}, in {} motions; (4.9) holds in {}, and with two features in {}", s.text(),
                                motions, leaves ? "none" : "some", more.stays() ? "all" : "not all"},
                   .number = number_of("dimensions left by the SOM of two segments", s.left(2))},
                  full_in_two(s) && leaves),
          studied("4.2-relative-observable", "head of Section 4.1.2",
                  "The relative map makes bearing-only SLAM with inertial sensors fully observable",
                  {.rule = Rule::dimension,
                   .measured = {"{}, in {} motions; what is left is the turn about a vertical, and only H F "
                                "sees it: {}",
                                s.text(), motions, yes_no(leaves_the_yaw(s))},
                   .number = left_in_truth(s),
                   .why = "the heading is not: turning all about a vertical changes no measurement. SOM and "
                          "TOM have full rank because H is frozen"},
                  InTruth{fully_observable(s), in_truth(leaves_the_yaw(s))}, ByMethod{full_in_two(s)})};
}

Claim range_and_bearing() {
  const Studies maps = by_features({1, 2}, relative_map("inertial-rb"));
  return studied(maps.cases(), "4.2-range-bearing-relative", "below (4.28), of [19]",
                 "With range and bearing the relative map is completely observable in two segments",
                 {.rule = Rule::dimension,
                  .measured = maps.text(),
                  .number = left_in_truth(*maps.begin(), ", with one feature"),
                  .why = "the heading is not, as with bearings alone"},
                 InTruth{maps.all(fully_observable), in_truth(maps.all(leaves_the_yaw))},
                 ByMethod{maps.all(full_in_two)});
}

std::vector<Claim> unaccelerated_claims() {
  const Study &falls = study(unaccelerated(relative(), Unaccelerated::falls)),
              &weightless = study(unaccelerated(relative(), Unaccelerated::weightless));
  const auto leaves = [](const Study& s) { return s.left(1) == 5 && s.left(2) == 2; };
  const std::vector<std::string> velocities{"vx", "vy", "vz"}, of_vertical{"vz", "phi", "theta", "rz_1"};
  return {
      studied(3, "4.2-relative-unaccelerated", "below (4.44)",
              "Without acceleration (f = 0) the rank of Q_1 is four, and the SOM of two segments leaves two",
              {.rule = Rule::dimension,
               .measured = {"{}, in {} motions: {}", legend, motions, by_unaccelerated(relative())},
               .number = number_of("dimensions left by the SOM of two segments, falling", falls.left(2))},
              leaves(falls) && leaves(weightless)),
      studied(
          2, "4.2-relative-unaccelerated-recovered", "below (4.44)",
          "Without acceleration (f = 0) the only observable state is the linear velocity",
          {.rule = Rule::dimension,
           .measured = {"states outside the null space, falling and without gravity: of the SOM of two "
                        "segments {}, and {}; of the motion itself {}, and {}",
                        listed(falls.observable(2)), listed(weightless.observable(2)),
                        listed(falls.observable_along()), listed(weightless.observable_along())},
           .number = left_in_truth(weightless, ", without gravity"),
           .why = "falling, gravity determines the vertical: speed and distance along it, roll and "
                  "pitch. Without gravity no length and no direction is observable"},
          InTruth{falls.observable_along() == velocities && weightless.observable_along() == velocities,
                  in_truth(falls.observable_along() == of_vertical && weightless.observable_along().empty())},
          ByMethod{falls.observable(2) == velocities && weightless.observable(2) == velocities})};
}

}  // namespace

std::vector<Claim> relative_claims() {
  return concatenated({measurement_matrix(), entries(), one_segment(), two_segments(), range_and_bearing(),
                       unaccelerated_claims()});
}

}  // namespace incognita::observability_claims::inertial
