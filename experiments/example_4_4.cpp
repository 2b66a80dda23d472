// Example 4.4: observability of a camera in space with unknown motion, with anchors.
//
// Experiment: the built-in system `cv6`, motions and rules of observability_claims.hpp: velocity and turn
// rate constant within a segment, changed by an unknown amount from one to the next; one feature, up to 4
// anchors. Printed vectors hold p, v, psi, omega, x_f in this order. Their r may be that of the feature or of
// the anchor, of either sign, in axes of the world or of the sensor: each vector is given the reading that
// suits it. F of (4.55) is compared with exact derivatives by misalignments, to 1e-9.
#include <array>

#include "experiments/common.hpp"
#include "experiments/example_4_2.hpp"

namespace incognita::observability_claims {
namespace {

const Vector3d zero = Vector3d::Zero();

const Study& in_space(int anchors, int features = 1) {
  return study({.system = "cv6", .features = features, .anchors = anchors});
}

VectorXd fifteen(const Vector3d& p, const Vector3d& v, const Vector3d& psi, const Vector3d& omega,
                 const Vector3d& feature) {
  return (VectorXd(15) << p, v, psi, omega, feature).finished();
}

/// The camera, the feature r and the anchor b from it, in axes of the world; without anchors b is r.
struct Begin {
  Matrix3d C;
  Vector3d r, b;
  explicit Begin(const Course& course) {
    const SystemPoint& p = course.points[0];
    C = inertial::C_of(p.x.segment<3>(6));
    r = p.x.tail<3>() - p.x.head<3>();
    b = p.anchors.size() > 0 ? Vector3d(p.anchors.head<3>() - p.x.head<3>()) : r;
  }
};

/// The vectors of (4.56) but the last, by one reading of r.
Basis printed_vectors(const Matrix3d& C, const Vector3d& r, double sign) {
  Basis all;
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = Vector3d::Unit(i);
    all.push_back(fifteen(zero, sign * C.row(i).transpose().cross(r), zero, e, zero));
    all.push_back(fifteen(sign * r.cross(e), zero, e, zero, zero));
  }
  return all;
}

/// How many of (4.56) lie in a study's space of one segment, always, each by its best reading.
int printed_inside(const Study& s, bool feature_in_axes_of_world) {
  std::vector<bool> inside(7, true);
  for (std::size_t i = 0; i < s.courses().size(); ++i) {
    const Begin at(s.courses()[i]);
    const auto contains = [&](const VectorXd& v) { return s.stripped(1)[i].contains(v); };
    for (std::size_t j = 0; j < 6; ++j)
      inside[j] =
          inside[j] &&
          std::ranges::any_of(
              std::array{at.r, at.b, Vector3d(at.C * at.r), Vector3d(at.C * at.b)}, [&](const Vector3d& r) {
                return contains(printed_vectors(at.C, r, 1)[j]) || contains(printed_vectors(at.C, r, -1)[j]);
              });
    const Vector3d along = feature_in_axes_of_world ? at.r : Vector3d(at.C * at.r);
    inside[6] = inside[6] && contains(fifteen(zero, zero, zero, zero, along));
  }
  return static_cast<int>(std::ranges::count(inside, true));
}

/// With one anchor: the feature's distance, the anchor's with feature, a turn about each axis, and what turn
/// rates can do together with the velocity so that neither feature nor anchor moves sideways.
Basis our_vectors(const Course& course) {
  const Begin at(course);
  const Vector3d d = at.r - at.b;
  Basis all{fifteen(zero, zero, zero, zero, at.r), fifteen(at.b, zero, zero, zero, at.b)};
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = Vector3d::Unit(i);
    all.push_back(fifteen(at.b.cross(e), zero, e, zero, at.b.cross(e) - at.r.cross(e)));
  }
  all.push_back(fifteen(zero, at.b.cross(d), zero, at.C * d, zero));
  const double along_b = at.r.dot(d), along_r = -at.b.dot(d);
  const Vector3d w = (along_b * at.b + along_r * at.r).cross(d) / d.squaredNorm();
  all.push_back(fifteen(zero, at.b.cross(w) + along_b * at.b, zero, at.C * w, zero));
  return all;
}

std::vector<Claim> one_segment_in_space() {
  const Study &one = in_space(1), &two = in_space(2);
  const auto inside = [](bool feature_in_axes_of_world) {
    return each_of({0, 1, 2}, [&](int n) { return printed_inside(in_space(n), feature_in_axes_of_world); });
  };
  const std::vector<int> as_printed = inside(false), in_world = inside(true);
  const bool ours = one.stripped_spanned_by(1, our_vectors);
  return {studied(2, "4.4-null-space", "(4.56)",
                  "With two anchors the null space of Q_1 has dimension seven, so that it has eight "
                  "combinations of states",
                  {.rule = Rule::dimension,
                   .measured = {"dimension with 1/2 anchors in {} motions {}/{}, rank {}/{}", motions,
                                one.left(1), two.left(1), 15 - one.left(1), 15 - two.left(1)},
                   .number = number_of("dimension of N(Q_1) with two anchors, of 15", two.left(1)),
                   .why = "two anchors leave three, and twelve combinations; seven are left by one"},
                  two.left(1) == 7, in_truth(ours && two.left(1) == 3)),
          studied(3, "4.4-basis", "(4.56)",
                  "The seven vectors of (4.56) lie in that null space, with one anchor or with two",
                  {.rule = Rule::dimension,
                   .printed = "[0 C_i' x r 0 e_i 0], [[x r]_i 0 e_i 0 0], [0 0 0 0 -r^s]",
                   .measured = {"in the null space with 0/1/2 anchors: {} of 7, {} with r for r^s; ours span "
                                "it with one anchor: {}",
                                joined(as_printed), joined(in_world), yes_no(ours)},
                   .number = exactly("vectors of seven in the null space with one anchor", as_printed[1]),
                   .why = "they belong to a camera without anchors. With one anchor at b: [0 0 0 0 r], [b 0 "
                          "0 0 b], [b x e_i 0 e_i 0 (b - r) x e_i], and two of v and omega, one of them "
                          "turning about d = r - b: [0 b x d 0 C d 0]"},
                  as_printed[1] == 7 || as_printed[2] == 7, in_truth(ours && in_world[0] == 7))};
}

Claim rows() {
  const auto rows = [](int anchors, int features) {
    return in_space(anchors, features).courses()[0].forms[0].H.rows();
  };
  const auto three = rows(3, 1), four = rows(4, 1);
  const bool general = three == 8 && four == 10 && rows(3, 2) == 10 && rows(4, 2) == 12;
  return assessed(
      "4.4-rows", "below (4.56)",
      "With one feature and three or more anchors H has ten rows, in general 2 nm + 2 na",
      {.rule = Rule::dimension,
       .printed = "10 x n, 2nm + 2na x n",
       .measured = {"with 3 anchors {}, with 4 {}; in general {}", three, four,
                    general ? "2 nm + 2 na" : "other numbers"},
       .number = exactly("rows of H with one feature and three anchors", static_cast<double>(three)),
       .why = "eight with three anchors; ten are four's",
       .runs = 4},
      general && three == 10, as_corrected(general && three == 8 && four == 10));
}

/// Everything turned about the line through the first two anchors.
Basis turn_about_line(const Course& course) {
  const VectorXd& anchors = course.points[0].anchors;
  const Vector3d first = anchors.head<3>(), axis = (anchors.segment<3>(3) - first).normalized(),
                 moved = axis.cross(first);
  const Basis turns = named({"rotation"})(course), translations = named({"translation"})(course);
  VectorXd v = VectorXd::Zero(15);
  for (std::size_t i = 0; i < 3; ++i) v += axis[i] * turns[i] - moved[i] * translations[i];
  return {v};
}

std::vector<Claim> two_segments() {
  const Studies cases = by_anchors({1, 2, 3, 4}, {.system = "cv6"}),
                enough = by_anchors({3, 4}, {.system = "cv6"});
  const Study& two = in_space(2);
  Studies both("with three anchors");
  const Study &space = both.add("space", in_space(3)),
              &plane = both.add("plane", study({.system = "planar-cv", .anchors = 3}));
  return {
      studied(
          4, "4.4-two-segments", "(4.57)",
          "With more than two anchors the system is observable in two segments, and the SOM has full rank",
          {.rule = Rule::dimension,
           .measured = {"{}. With two SOM and TOM have full rank in two segments: {}; the motion itself "
                        "leaves the turn of all about the line through them: {}",
                        cases.text(), yes_no(two.full_rank(2)),
                        yes_no(two.along_spanned_by(turn_about_line))},
           .number = left_in_truth(in_space(3), ", with three anchors")},
          InTruth{enough.all(fully_observable)}, ByMethod{enough.all(full_in_two)}),
      studied(both.cases(), "4.4-as-on-the-plane", "end of Example 4.4",
              "That is as with the constant-velocity model of the plane: with three anchors as many "
              "dimensions are left",
              {.rule = Rule::dimension,
               .measured = both.text(),
               .number = left_in_truth(plane, " on the plane, with three anchors")},
              InTruth{space.true_dimension() == plane.true_dimension()},
              ByMethod{space.dimensions() == plane.dimensions()})};
}

/// F of (4.55) by misalignments, without the feature's rows and columns; its first state p or r = x_f - p.
double wrong_F(bool told_from_vehicle) {
  return largest(in_space(1), [&](const Course& course) {
    const SystemPoint& p = course.points[0];
    const Vector3d angles = p.x.segment<3>(6);
    MatrixXd exact = inertial::misaligned(course.exact[0], angles, 6, p.x.segment<3>(9)).F,
             printed = MatrixXd::Zero(15, 15);
    if (told_from_vehicle) exact.topRows(3) = exact.bottomRows(3) - exact.topRows(3);
    printed.block<3, 3>(0, 3).setIdentity();
    printed.block<3, 3>(6, 9) = inertial::C_of(angles).transpose();
    return apart(exact, printed);
  });
}

Claim error_form() {
  const double of_r = wrong_F(true), of_p = wrong_F(false);
  return studied(
      "4.4-F", "(4.55) and F below it",
      "The error form of (4.54) is r' = v, v' = 0, psi' = C' omega, omega' = 0, to 1e-9",
      {.printed = "r' = v~",
       .measured =
           {"largest difference of F from exact derivatives in {} motions: for r = x_f - p {:.2g}, for p {}",
            motions, of_r, below(of_p)},
       .number = exactly("largest difference of the printed F, for r", of_r),
       .why = "p' = v. F is right, but for the feature's zeros, which it leaves out"},
      of_r < rounding, as_corrected(of_p < rounding));
}

LedgerEntry run_example_4_4(const ExperimentSettings& settings) {
  return entry_of(example_4_4, settings, {error_form(), one_segment_in_space(), rows(), two_segments()});
}

}  // namespace
}  // namespace incognita::observability_claims

const incognita::Experiment incognita::example_4_4{
    "4.4", "Bearings at constant velocity in space", {}, observability_claims::run_example_4_4};
