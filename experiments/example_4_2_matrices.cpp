// Example 4.2, matrices: the error form of inertial SLAM against derivatives of the equations that it comes
// from.
//
// Experiment: the built-in system `inertial`, motions of observability_claims.hpp. Misalignment angles turn
// about the axes of the world, so that Euler angles change by E C of them: with that its exact derivatives
// become those of the error form. Also without turning, f held: F is constant then in each of ten segments,
// and [H_1; H_2 e^(F_1 t); ...] is the observability matrix of the error form along the motion. Holds: to
// 1e-9. The printed [x a] may be [a x] or its negative, r in axes of the world or of the sensor, whichever
// comes nearest, but the same sign in F and H.
#include <unsupported/Eigen/MatrixFunctions>

#include "experiments/common.hpp"
#include "experiments/example_4_2.hpp"

namespace incognita::observability_claims::inertial {

Case unaccelerated(Case which, Unaccelerated how) {
  which.motion = "unaccelerated";
  if (how == Unaccelerated::weightless)
    which.change = {"weightless", [](SystemText& text) { text.parameters.at(0).value = 0; }};
  if (how == Unaccelerated::carried) {
    which.motion = "stationary";
    which.change = {"carried", [](SystemText& text) {
                      for (MotionText& motion : text.motions)
                        std::erase_if(motion.assignments,
                                      [](const NamedExpression& a) { return a.name[0] == 'v'; });
                    }};
  }
  return which;
}

std::string by_unaccelerated(const Case& which) {
  const auto numbers = [&](Unaccelerated how) { return study(unaccelerated(which, how)).numbers(); };
  return fmt::format(
      "f = 0, falling: {}; f = 0 without gravity: {}; constant velocity under gravity, f = -g: {}",
      numbers(Unaccelerated::falls), numbers(Unaccelerated::weightless), numbers(Unaccelerated::carried));
}

Matrix3d C_of(const Vector3d& a) {
  const double cf = std::cos(a[0]), sf = std::sin(a[0]), ct = std::cos(a[1]), st = std::sin(a[1]),
               cp = std::cos(a[2]), sp = std::sin(a[2]);
  return (Matrix3d() << cp * ct, sp * ct, -st, cp * st * sf - sp * cf, sp * st * sf + cp * cf, ct * sf,
          cp * st * cf + sp * sf, sp * st * cf - cp * sf, ct * cf)
      .finished();
}

Matrix3d E_of(const Vector3d& a) {
  const double cf = std::cos(a[0]), sf = std::sin(a[0]), t = std::tan(a[1]), c = std::cos(a[1]);
  return (Matrix3d() << 1, sf * t, cf * t, 0, cf, -sf, 0, sf / c, cf / c).finished();
}

Matrix3d cross(const Vector3d& a) {
  return (Matrix3d() << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0).finished();
}

Matrix23 bearings_by(const Vector3d& s) {
  const double d2 = s.head<2>().squaredNorm(), d = std::sqrt(d2), D = s.squaredNorm();
  return (Matrix23() << -s.y() / d2, s.x() / d2, 0, -s.x() * s.z() / (d * D), -s.y() * s.z() / (d * D), d / D)
      .finished();
}

MatrixXd beside(const std::vector<MatrixXd>& blocks) {
  MatrixXd all(blocks[0].rows(), 0);
  for (const MatrixXd& block : blocks) {
    all.conservativeResize(Eigen::NoChange, all.cols() + block.cols());
    all.rightCols(block.cols()) = block;
  }
  return all;
}

Misaligned misaligned(const LinearizedSystem& exact, const Vector3d& angles, Index first,
                      const Vector3d& rate) {
  constexpr double h = 1e-3;
  const Vector3d rates = E_of(angles) * rate;
  const auto T = [&](double steps) -> Matrix3d {  // Euler angles by misalignments
    const Vector3d then = angles + steps * h * rates;
    return E_of(then) * C_of(then);
  };
  const Index n = exact.F.rows();
  MatrixXd S = MatrixXd::Identity(n, n), S_rate = MatrixXd::Zero(n, n);  // ours by those
  S.block<3, 3>(first, first) = T(0);
  // by five points: their error, and rounding, are below 1e-12
  S_rate.block<3, 3>(first, first) = (T(-2) - 8 * T(-1) + 8 * T(1) - T(2)) / (12 * h);
  return {S.inverse() * (exact.F * S - S_rate), exact.H * S};
}

Begin::Begin(const Course& course) {
  const SystemPoint& p = course.points[0];
  const bool relative = p.x.size() == 9;
  const Index first = relative ? 3 : 6;
  const Vector3d angles = p.x.segment<3>(first);
  C = C_of(angles);
  r = relative ? Vector3d(p.x.tail<3>()) : Vector3d(p.x.tail<3>() - p.x.head<3>());
  f = C.transpose() * p.u.head<3>();
  A = bearings_by(C * r);
  exact = misaligned(course.exact[0], angles, first, p.u.tail<3>());
}

namespace {

/// What the error form leaves with its own transitions, f held for a segment and without turning.
int left_by_transitions(double sign) {
  const auto level = [](SystemText& text) {
    MotionText held = text.motions.at(1);  // stationary
    std::erase_if(held.assignments, [](const NamedExpression& a) { return a.name[0] != 'w'; });
    held.name = "level";
    text.motions.push_back(held);
  };
  const Study& s =
      study({.system = "inertial", .motion = "level", .change = {"level", level}, .segments = 10});
  return dimension(null_spaces(s, [&](const Course& course) {
    MatrixXd M(0, 12), moved = MatrixXd::Identity(12, 12);
    for (const LinearizedSystem& form : course.forms) {
      MatrixXd F = form.F;
      F.block<3, 3>(3, 6) *= sign;
      M.conservativeResize(M.rows() + 2, 12);
      M.bottomRows(2) = form.H * moved;
      moved = (in_space_s * F).exp() * moved;
    }
    return M;
  }));
}

Claim force_matrix() {
  const Study& s = study(world());
  const auto wrong = [&](double in_h, double in_f) {
    return largest(s, [&](const Course& course) {
      const Begin b(course);
      return std::max(apart(b.exact.H.middleCols(6, 3), in_h * b.A * b.C * cross(b.r)),
                      apart(b.exact.F.block<3, 3>(3, 6), in_f * cross(b.f)));
    });
  };
  const double printed = std::min(wrong(1, 1), wrong(-1, -1)), corrected = wrong(1, -1);
  const auto other = [](LinearizedSystem& form, const SystemPoint&) { form.F.block<3, 3>(3, 6) *= -1; };
  const auto with_other = each_of({1, 2, 3}, [&](int k) { return dimension(stripped_with(s, k, other)); });
  const int left = left_by_transitions(1), left_as_printed = left_by_transitions(-1);
  return studied(
      2, "4.2-F", "(4.30), (4.31)", "F has [x f], of the sign that [x r] has in H, to 1e-9",
      {.printed = "[x f_j], beside [x r]",
       .measured = {"largest difference from exact derivatives in {} motions: printed {:.2g}, ours {}. SOM "
                    "{} distinguish them: it leaves {} and {}. With exact transitions, not turning, the "
                    "printed sign leaves {} and the other {}; the motion itself leaves {}",
                    motions, printed, below(corrected), with_other == s.dimensions() ? "does not" : "does",
                    joined(with_other), joined(s.dimensions()), left_as_printed, left, s.true_dimension()},
       .number = exactly("largest difference of the printed entries", printed),
       .why = "the other sign: -[f x] beside [r x], f and r in axes of the world"},
      printed < rounding, as_corrected(corrected < rounding && left == s.true_dimension()));
}

Claim partials() {
  Worst worst;
  for (const Course& course : study(world()).courses()) {
    const Begin b(course);
    Matrix23 as_printed = b.A;
    as_printed(1, 1) *= -1;
    worst.take(as_printed, b.A, b.exact.H.rightCols(3) * b.C.transpose());
  }
  return studied(
      "4.2-partials", "(4.34)", "Derivative of azimuth and elevation by r^s, to 1e-9",
      {.printed = "second row [-r_x r_z, r_y r_z, (d^s)^2]/(d^s ((d^s)^2 + r_z^2)), 0_2x3 in the first",
       .measured = {"largest difference in {} motions: {}", motions, worst.text()},
       .number = exactly("largest difference of the printed entries", worst.printed),
       .why = "[-r_x r_z, -r_y r_z, d^2]/(d (d^2 + r_z^2)), and one 0"},
      worst, rounding);
}

/// dz/dr^s [-I 0 [x r] of_feature I], by one reading: whether C stands behind dz/dr^s, r in axes of the
/// sensor, the sign of [x r]. r in axes of the world.
MatrixXd rows_by(const Matrix3d& C, const Vector3d& r, double of_feature, bool turned, bool r_of_sensor,
                 double sign) {
  const Matrix3d I = Matrix3d::Identity(), O = Matrix3d::Zero();
  const Vector3d r_s = C * r;
  const Matrix23 A = turned ? Matrix23(bearings_by(r_s) * C) : bearings_by(r_s);
  return A * beside({-I, O, sign * cross(r_of_sensor ? r_s : r), of_feature * I});
}

/// Largest difference from exact derivatives, of the feature's rows or those of three anchors.
double wrong_rows(bool of_anchors, bool turned, bool r_of_sensor, double sign) {
  return largest(study(world(1, of_anchors ? 3 : 0)), [&](const Course& course) {
    const Begin b(course);
    const SystemPoint& p = course.points[0];
    if (!of_anchors) return apart(rows_by(b.C, b.r, 1, turned, r_of_sensor, sign), b.exact.H);
    double difference = 0;
    for (Index i = 0; i < 3; ++i) {
      const Vector3d to_anchor = p.anchors.segment<3>(3 * i) - p.x.head<3>();
      difference = std::max(difference, apart(rows_by(b.C, to_anchor, 0, turned, r_of_sensor, sign),
                                              b.exact.H.middleRows(2 + 2 * i, 2)));
    }
    return difference;
  });
}

std::vector<Claim> measurement_rows() {
  const auto nearest_and_ours = [](bool of_anchors) -> Worst {
    const auto printed = [&](bool r_of_sensor, double sign) {
      return wrong_rows(of_anchors, false, r_of_sensor, sign);
    };
    return {std::min({printed(false, 1), printed(false, -1), printed(true, 1), printed(true, -1)}),
            wrong_rows(of_anchors, true, false, 1)};
  };
  const Worst of_feature = nearest_and_ours(false), of_anchors = nearest_and_ours(true);
  return {studied("4.2-H", "(4.32), (4.33)", "H is dz/dr^s [-I 0 [x r] I], to 1e-9",
                  {.printed = "(dz/dr^s) [-I 0 [x r] I]",
                   .measured = {"largest difference from exact derivatives in {} motions: {}", motions,
                                of_feature.text()},
                   .number = exactly("largest difference of the printed entries, by their best reading",
                                     of_feature.printed),
                   .why = "dz/dr^s C [-I 0 [r x] I], r in axes of the world"},
                  of_feature, rounding),
          studied("4.2-anchored-H", "(4.36), (4.37)",
                  "Rows of H for an anchor are dz/dr^s [-I 0 [x r] 0], with its r, to 1e-9",
                  {.printed = "(dz/dr^s) [-I 0 [x r] 0]",
                   .measured = {"largest difference from exact derivatives in {} motions, three anchors: {}",
                                motions, of_anchors.text()},
                   .number = exactly("largest difference of the printed entries, by their best reading",
                                     of_anchors.printed),
                   .why = "dz/dr^s C [-I 0 [r x] 0], r in axes of the world"},
                  of_anchors, rounding)};
}

}  // namespace

std::vector<Claim> matrix_claims() { return concatenated({force_matrix(), partials(), measurement_rows()}); }

}  // namespace incognita::observability_claims::inertial
