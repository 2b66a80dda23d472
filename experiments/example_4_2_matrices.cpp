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

Case world(int features, int anchors) {
  return {.system = "inertial", .features = features, .anchors = anchors};
}

Case relative(int features) {
  return {.system = "inertial", .representation = "relative", .features = features};
}

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

namespace {

/// Euler angles by misalignments.
Matrix3d T_of(const Vector3d& angles) { return E_of(angles) * C_of(angles); }

/// How T changes while the angles change so fast, by five points: their error, and rounding, are below 1e-12.
Matrix3d rate_of_T(const Vector3d& angles, const Vector3d& by) {
  constexpr double h = 1e-3;
  const auto T = [&](double steps) { return T_of(angles + steps * h * by); };
  return (T(-2) - 8 * T(-1) + 8 * T(1) - T(2)) / (12 * h);
}

}  // namespace

Misaligned misaligned(const LinearizedSystem& exact, const Vector3d& angles, Eigen::Index first,
                      const Vector3d& rate) {
  const Eigen::Index n = exact.F.rows();
  MatrixXd S = MatrixXd::Identity(n, n), S_rate = MatrixXd::Zero(n, n);  // ours by those
  S.block<3, 3>(first, first) = T_of(angles);
  S_rate.block<3, 3>(first, first) = rate_of_T(angles, E_of(angles) * rate);
  return {S.inverse() * (exact.F * S - S_rate), exact.H * S};
}

namespace {

/// What the matrices are made of, where a motion begins.
struct Begin {
  Matrix3d C, T;          ///< T: Euler angles by misalignments
  Vector3d r, f;          ///< in axes of the world
  Matrix23 by_r;          ///< exact derivative of the measurements by r^s
  MatrixXd H_psi, F_psi;  ///< exact derivatives of measurements, and of the velocity's rate, by misalignments

  explicit Begin(const Course& course) {
    const SystemPoint& p = course.points[0];
    C = C_of(p.x.segment<3>(6));
    T = T_of(p.x.segment<3>(6));
    r = p.x.segment<3>(9) - p.x.head<3>();
    f = C.transpose() * p.u.head<3>();
    by_r = course.exact[0].H.middleCols(9, 3) * C.transpose();
    H_psi = course.exact[0].H.middleCols(6, 3) * T;
    F_psi = course.exact[0].F.block<3, 3>(3, 6) * T;
  }
};

/// No turning, f held for a segment.
const Study& level() {
  const auto change = [](SystemText& text) {
    MotionText held = text.motions.at(1);  // stationary
    std::erase_if(held.assignments, [](const NamedExpression& a) { return a.name[0] != 'w'; });
    held.name = "level";
    text.motions.push_back(held);
  };
  return study({.system = "inertial", .motion = "level", .change = {"level", change}, .segments = 10});
}

/// What the error form leaves with its own transitions.
int left_by_transitions(double sign) {
  return dimension(null_spaces(level(), [&](const Course& course) {
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
      return std::max(apart(b.H_psi, b.by_r * b.C * in_h * cross(b.r)), apart(b.F_psi, in_f * cross(b.f)));
    });
  };
  const double printed = std::min(wrong(1, 1), wrong(-1, -1)), corrected = wrong(1, -1);
  const auto other = [](LinearizedSystem& form, const SystemPoint&) { form.F.block<3, 3>(3, 6) *= -1; };
  const auto with_other = each_of({1, 2, 3}, [&](int k) { return dimension(stripped_with(s, k, other)); });
  const int left = left_by_transitions(1), left_as_printed = left_by_transitions(-1);
  return studied("4.2-F", "(4.30), (4.31)", "F has [x f], of the sign that [x r] has in H, to 1e-9",
                 {.printed = "the same sign",
                  .measured = fmt::format(
                      "largest difference from exact derivatives in {} motions: printed {:.2g}, ours {}. SOM "
                      "{} distinguish them: it leaves {} and {}. With exact transitions, not turning, the "
                      "printed sign leaves {} and the other {}; the motion itself leaves {}",
                      motions, printed, below(corrected), with_other == s.dimensions() ? "does not" : "does",
                      joined(with_other), joined(s.dimensions()), left_as_printed, left, s.true_dimension()),
                  .why = "the other sign: -[f x] beside [r x], f and r in axes of the world",
                  .runs = 2 * motions},
                 printed < rounding, corrected < rounding && left == s.true_dimension());
}

Claim partials() {
  Worst worst;
  for (const Course& course : study(world()).courses()) {
    const Begin b(course);
    const Matrix23 ours = bearings_by(b.C * b.r);
    Matrix23 as_printed = ours;
    as_printed(1, 1) *= -1;
    worst.take(as_printed, ours, b.by_r);
  }
  return studied("4.2-partials", "(4.34)", "Derivative of azimuth and elevation by r^s, to 1e-9",
                 {.printed = "second row [-, +, +], and 0_2x3 in the first",
                  .measured = fmt::format("largest difference in {} motions: {}", motions, worst.text()),
                  .why = "[-r_x r_z, -r_y r_z, d^2]/(d (d^2 + r_z^2)), and one 0"},
                 worst, rounding);
}

Claim measurement_matrix() {
  const auto wrong = [](bool turned, bool r_of_sensor) {
    return largest(study(world()), [&](const Course& course) {
      const Begin b(course);
      const Matrix23 A = turned ? Matrix23(b.by_r * b.C) : b.by_r;
      const Matrix3d by_psi = cross(r_of_sensor ? Vector3d(b.C * b.r) : b.r);
      const MatrixXd& H = course.exact[0].H;
      const double angles = std::min(apart(b.H_psi, A * by_psi), apart(b.H_psi, -A * by_psi));
      return std::max({apart(H.leftCols(3), -A), apart(H.middleCols(3, 3), MatrixXd::Zero(2, 3)),
                       apart(H.rightCols(3), A), angles});
    });
  };
  const Worst worst{std::min(wrong(false, false), wrong(false, true)), wrong(true, false)};
  return studied("4.2-H", "(4.32), (4.33)", "H is dz/dr^s [-I 0 [x r] I], to 1e-9",
                 {.measured = fmt::format("largest difference from exact derivatives in {} motions: {}",
                                          motions, worst.text()),
                  .why = "dz/dr^s C [-I 0 [r x] I], r in axes of the world"},
                 worst, rounding);
}

/// [-I 0 [x r] 0] before which dz/dr^s stands, or that with C; r of the anchor, by one sign of [x r].
double wrong_anchor_rows(bool turned, bool r_of_sensor, double sign) {
  return largest(study(world(1, 3)), [&](const Course& course) {
    const SystemPoint& p = course.points[0];
    const Matrix3d C = C_of(p.x.segment<3>(6));
    const Misaligned exact = misaligned(course.exact[0], p.x.segment<3>(6), 6, p.u.tail<3>());
    double difference = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Vector3d b = p.anchors.segment<3>(3 * i) - p.x.head<3>(), s = C * b;
      const Matrix23 A = turned ? Matrix23(bearings_by(s) * C) : bearings_by(s);
      const Matrix3d O = Matrix3d::Zero();
      const MatrixXd rows = A * beside({-Matrix3d::Identity(), O, sign * cross(r_of_sensor ? s : b), O});
      difference = std::max(difference, apart(rows, exact.H.middleRows(2 + 2 * i, 2)));
    }
    return difference;
  });
}

Claim anchor_rows() {
  const Worst worst{std::min({wrong_anchor_rows(false, false, 1), wrong_anchor_rows(false, false, -1),
                              wrong_anchor_rows(false, true, 1), wrong_anchor_rows(false, true, -1)}),
                    wrong_anchor_rows(true, false, 1)};
  return studied(
      "4.2-anchored-H", "(4.36), (4.37)",
      "Rows of H for an anchor are dz/dr^s [-I 0 [x r] 0], with its r, to 1e-9",
      {.measured = fmt::format("largest difference from exact derivatives in {} motions, three anchors: {}",
                               motions, worst.text()),
       .why = "dz/dr^s C [-I 0 [r x] 0], r in axes of the world"},
      worst, rounding);
}

}  // namespace

std::vector<Claim> matrix_claims() {
  return {force_matrix(), partials(), measurement_matrix(), anchor_rows()};
}

}  // namespace incognita::observability_claims::inertial
