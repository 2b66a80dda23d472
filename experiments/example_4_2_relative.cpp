// Example 4.2, relative map: features told from the vehicle, in axes of the world.
//
// Experiment: the built-in systems `inertial` and `inertial-rb` in their relative forms, motions and rules of
// observability_claims.hpp; also unaccelerated, as in example_4_2.cpp.
// Printed vectors hold r, v, psi in this order; r is p - x_f there and x_f - p here, which only a vector with
// both r and psi would tell.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "experiments/evidence.hpp"
#include "experiments/example_4_2.hpp"

namespace incognita::observability_claims::inertial {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd nine(const Vector3d& r, const Vector3d& v, const Vector3d& psi) {
  return (VectorXd(9) << v, psi, r).finished();
}

Vector3d r_of(const SystemPoint& p) { return p.x.segment<3>(6); }

/// Everything turned about a vertical, as Euler angles see it.
std::vector<VectorXd> yawed(const Course& c) {
  const SystemPoint& p = c.points[0];
  const Vector3d up = Vector3d::UnitZ();
  VectorXd v(p.x.size());
  v.head<6>() << up.cross(p.x.head<3>()), up;
  for (Eigen::Index i = 6; i < v.size(); i += 3) v.segment<3>(i) = up.cross(p.x.segment<3>(i));
  return {v};
}

bool leaves_the_yaw(const Study& s) { return are_basis(s.along(), s.courses(), yawed); }

Claim independent_rows() {
  const int left = dimension(study(relative()).stripped(1));
  return judged({.id = "4.2-relative-Q1",
                 .place = "(4.41)",
                 .statement = "Q_1 has six independent rows",
                 .printed = "6",
                 .measured = fmt::format("rank {} of 9 in {} motions", 9 - left, motions),
                 .why = "it has not",
                 .runs = motions},
                left == 3);
}

/// Of (4.42), with `directed` for what is printed as C r.
std::vector<VectorXd> vectors_4_42(const Course& c, bool directed_as_printed) {
  const SystemPoint& p = c.points[0];
  const Eigen::Matrix3d C = C_of(p.x.segment<3>(3));
  const Vector3d r = r_of(p), f = C.transpose() * p.u.head<3>(), zero = Vector3d::Zero(),
                 along = directed_as_printed ? Vector3d(C * r) : r;
  Vector3d zeta = -r.cross(f);
  zeta -= zeta.y() / r.y() * r;  // a multiple of r puts the zero where it is printed
  return {nine(along, zero, zero), nine(zeta, zero, f), nine(zero, along, zero)};
}

Claim instant_null_space() {
  const Study& s = study(relative());
  const auto basis = [&](bool as_printed) {
    return are_basis(s.stripped(1), s.courses(),
                     [&](const Course& c) { return vectors_4_42(c, as_printed); });
  };
  return judged(
      {.id = "4.2-relative-null-space",
       .place = "(4.42), (4.43)",
       .statement = "Null space of one segment",
       .printed = "[C r 0 0], [zeta 0 f], [0 C r 0]: dimension 3",
       .measured = fmt::format("dimension {} of 9 in {} motions; spanned with C r: {}, with r: {}",
                               dimension(s.stripped(1)), motions, basis(true) ? "yes" : "no",
                               basis(false) ? "yes" : "no"),
       .why = "r in axes of the world, as f, in place of C r. zeta is r x f up to sign and multiples of r, "
              "which put its zero along r_y as printed or, as the text has it, along r_x",
       .runs = motions},
      basis(true), basis(false));
}

Claim partially_reconstructed() {
  const Study& s = study(relative());
  const auto seen = seen_states(s.stripped(1), s.error_states());
  return judged(
      {.id = "4.2-relative-partially",
       .place = "below (4.43)",
       .statement = "Relative position and misalignment can only be partially reconstructed in one segment",
       .printed = "partially",
       .measured =
           fmt::format("states outside N(Q_1) in {} motions: {}; nor is the velocity", motions, listed(seen)),
       .why = "they can",
       .runs = motions},
      seen.empty());
}

Claim two_segments() {
  const Study &s = study(relative()), &more = study(relative(2));
  const bool full = dimension(s.stripped(2)) == 0 && dimension(s.total(2)) == 0;
  const bool leaves =
      std::none_of(s.courses().begin(), s.courses().end(), [](const Course& c) { return c.stays; });
  return judged(
      {.id = "4.2-relative-two-segments",
       .place = "(4.44)",
       .statement = "SOM and TOM have full rank in two segments, although N(Q_j) is not within N(F_j)",
       .printed = "0",
       .measured = fmt::format("{}, in {} motions; (4.9) holds in {}, and with two features in {}", s.text(),
                               motions, leaves ? "none" : "some", more.stays() ? "all" : "not all"),
       .why = "they have not",
       .runs = 2 * motions},
      full && leaves);
}

Claim fully_observable() {
  const Study& s = study(relative());
  return judged(
      {.id = "4.2-relative-observable",
       .place = "head of Section 4.1.2",
       .statement = "The relative map makes bearing-only SLAM with inertial sensors fully observable",
       .printed = "fully",
       .measured = fmt::format("{}, in {} motions", s.text(), motions),
       .why =
           "up to the heading: turning all about a vertical changes no look. SOM and TOM find it because H "
           "is frozen",
       .runs = motions},
      s.true_dimension() == 0, leaves_the_yaw(s));
}

Claim range_and_bearing() {
  std::vector<std::string> lines;
  bool as_matrices = true, all = true, but_the_heading = true;
  for (const int features : {1, 2}) {
    const Study& s = study({.system = "inertial-rb",
                            .representation = "relative",
                            .features = features,
                            .segment_s = in_space_s});
    lines.push_back(fmt::format("{}: {}", features, s.numbers()));
    as_matrices = as_matrices && dimension(s.stripped(2)) == 0;
    all = all && s.true_dimension() == 0;
    but_the_heading = but_the_heading && leaves_the_yaw(s);
  }
  return judged(
      {.id = "4.2-range-bearing-relative",
       .place = "below (4.28), of [19]",
       .statement = "With range and bearing the relative map is completely observable in two segments",
       .printed = "completely",
       .measured = fmt::format("{}, by features: {}", legend, fmt::join(lines, "; ")),
       .why = "up to the heading, as with bearings alone",
       .runs = 2 * motions},
      as_matrices && all, as_matrices && but_the_heading);
}

Claim unaccelerated_ranks() {
  bool all = true;
  for (const auto how : {Unaccelerated::falls, Unaccelerated::weightless}) {
    const Study& s = study(unaccelerated(relative(), how));
    all = all && dimension(s.stripped(1)) == 5 && dimension(s.stripped(2)) == 2;
  }
  return judged(
      {.id = "4.2-relative-unaccelerated",
       .place = "below (4.44)",
       .statement =
           "Without acceleration (f = 0) the rank of Q_1 is four, and the SOM of two segments leaves "
           "two",
       .printed = "4 of 9, 2",
       .measured = fmt::format("{}, in {} motions: {}", legend, motions, by_unaccelerated(relative())),
       .why = "they are others",
       .runs = 3 * motions},
      all);
}

Claim unaccelerated_recovered() {
  std::vector<std::string> in_som, along;
  const std::vector<std::string> velocities{"vx", "vy", "vz"};
  bool printed = true;
  for (const auto how : {Unaccelerated::falls, Unaccelerated::weightless}) {
    const Study& s = study(unaccelerated(relative(), how));
    in_som.push_back(listed(seen_states(s.stripped(2), s.error_states())));
    along.push_back(listed(seen_states(s.along(), s.states())));
    printed = printed && seen_states(s.along(), s.states()) == velocities;
  }
  return judged(
      {.id = "4.2-relative-unaccelerated-recovered",
       .place = "below (4.44)",
       .statement = "Without acceleration (f = 0) the only observable state is the linear velocity",
       .printed = "velocity",
       .measured =
           fmt::format("states outside the null space, falling and without gravity: of the SOM of two "
                       "segments {}, and {}; of the motion itself {}, and {}",
                       in_som[0], in_som[1], along[0], along[1]),
       .why = "falling, gravity tells the vertical: speed and distance along it, roll and pitch. Without "
              "gravity nothing tells lengths or directions",
       .runs = 2 * motions},
      printed);
}

}  // namespace

std::vector<Claim> relative_claims() {
  return {independent_rows(), instant_null_space(), partially_reconstructed(), two_segments(),
          fully_observable(), range_and_bearing(),  unaccelerated_ranks(),     unaccelerated_recovered()};
}

}  // namespace incognita::observability_claims::inertial
