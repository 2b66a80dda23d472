// Example 4.1 with anchors: how many it takes to observe a vehicle of the plane with a camera.
//
// Experiment: the built-in systems `planar` and `planar-rb` (ranges and bearings), motions and rules of
// observability_claims.hpp; up to 3 anchors.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/evidence.hpp"
#include "experiments/example_4_1.hpp"

namespace incognita::observability_claims::planar {

using Eigen::Vector2d;
using Eigen::VectorXd;

const Study& world(int features, int anchors, int segments) {
  return study({.system = "planar", .features = features, .anchors = anchors, .segments = segments});
}

VectorXd five(double x, double y, double theta, double xf, double yf) {
  return (VectorXd(5) << x, y, theta, xf, yf).finished();
}

Vector2d r_of(const SystemPoint& point) { return point.x.segment<2>(3) - point.x.head<2>(); }

VectorXd turn(const SystemPoint& point, const Vector2d& about) {
  VectorXd v = VectorXd::Zero(point.x.size());
  const auto turned = [&](const Vector2d& at) { return Vector2d(-(at - about).y(), (at - about).x()); };
  v.head<2>() = turned(point.x.head<2>());
  v[2] = 1;
  for (Eigen::Index i = 3; i < v.size(); i += 2) v.segment<2>(i) = turned(point.x.segment<2>(i));
  return v;
}

namespace {

Claim anchored_h() {
  double printed = 0, corrected = 0;
  for (const Course& course : world(1, 2).courses())
    for (int i = 0; i < 2; ++i) {
      const Vector2d b = course.points[0].anchors.segment<2>(2 * i) - course.points[0].x.head<2>();
      const double da = b.squaredNorm();
      const VectorXd row = course.exact[0].H.row(1 + i);
      const auto wrong = [&](double over) {
        return (row - five(b.y() / over, -b.x() / over, -1, 0, 0)).cwiseAbs().maxCoeff();
      };
      printed = std::max(printed, wrong(da * da)), corrected = std::max(corrected, wrong(da));
    }
  return assessed({.id = "4.1-anchored-H",
                   .place = "(4.21)",
                   .statement = "Rows of H for anchors are the derivatives of (4.12), to 1e-9",
                   .printed = "divided by da^2, da = (a_y - y)^2 + (a_x - x)^2",
                   .measured = fmt::format("largest difference in {} motions: printed {:.2g}, ours {}",
                                           motions, printed, below(corrected)),
                   .why = "da is the square already",
                   .runs = motions},
                  printed < rounding, corrected < rounding);
}

Claim anchored_null_space() {
  const Study& s = world(1, 2);
  const bool basis = are_basis(s.stripped(1), s.courses(), [](const Course& c) -> std::vector<VectorXd> {
    const Vector2d r = r_of(c.points[0]);
    return {five(0, 0, 0, -r.x(), -r.y())};
  });
  return assessed({.id = "4.1-anchored-null-space",
                   .place = "(4.22)",
                   .statement = "Null space of one segment with two anchors: the distance of the feature",
                   .printed = "dimension 1",
                   .measured = fmt::format("dimension {} of 5 in {} motions; the printed vector spans it: {}",
                                           dimension(s.stripped(1)), motions, basis ? "yes" : "no"),
                   .runs = motions},
                  basis);
}

Claim anchored_two_segments() {
  const Study& s = world(1, 2);
  return assessed(
      {.id = "4.1-anchored-two-segments",
       .place = "below (4.22)",
       .statement = "With two anchors vehicle and feature are completely observable in two segments",
       .printed = "0",
       .measured = fmt::format("{}, in {} motions", s.text(), motions),
       .runs = motions},
      dimension(s.stripped(2)) == 0 && s.true_dimension() == 0);
}

Claim anchored_total() {
  std::vector<std::string> lines;
  bool stays = true, full = true;
  for (const int anchors : {1, 2, 3}) {
    const Study& s = world(1, anchors);
    lines.push_back(fmt::format("{}: {}", anchors, joined(s.total_dimensions())));
    stays = stays && s.stays();
    full = full && dimension(s.total(2)) == 0;
  }
  return assessed(
      {.id = "4.1-anchored-total",
       .place = "below (4.22)",
       .statement = "N(Q_j) is within N(F_j), and the TOM has full rank in two segments, for one or more "
                    "anchors",
       .printed = "0",
       .measured = fmt::format("(4.9) holds in {} segments; dimensions left by the TOM after 1/2/3 segments, "
                               "by anchors: {}",
                               stays ? "all" : "not all", fmt::join(lines, "; ")),
       .runs = 3 * motions},
      stays && full);
}

/// SOM and TOM fall short in one segment, and in two they do not.
bool full_in_two(const Study& s) {
  return dimension(s.stripped(1)) > 0 && dimension(s.total(1)) > 0 && dimension(s.stripped(2)) == 0 &&
         dimension(s.total(2)) == 0;
}

bool never_full(const Study& s) { return dimension(s.stripped(3)) > 0 && dimension(s.total(3)) > 0; }

/// Said of the linear analysis, so it is SOM and TOM that decide; the motion itself is shown beside them.
Claim anchors_needed() {
  std::vector<std::string> lines;
  for (const int anchors : {0, 1, 2, 3})
    lines.push_back(fmt::format("{}: {}", anchors, world(1, anchors).numbers()));
  const Study &one = world(1, 1), &two = world(1, 2), &at_once = world(1, 2, 1);
  const bool one_does = full_in_two(one) && never_full(world(1, 0)),
             always_two = full_in_two(two) && full_in_two(world(1, 3)),
             in_truth_two_and_one = one.true_dimension() > 0 && at_once.true_dimension() == 0;
  return assessed(
      {.id = "4.1-anchors-needed",
       .place = "above (4.21)",
       .statement = "For the linear analysis two anchors and two time segments are needed for full "
                    "observability",
       .printed = "two and two",
       .measured = fmt::format("{}, by anchors: {}. The motion itself leaves {} in one segment with two",
                               legend, fmt::join(lines, "; "), joined({at_once.true_dimension()})),
       .why = "two segments, but one anchor: so SOM and TOM have it, as the next sentence of the text does. "
              "For the motion itself it is two anchors and one segment",
       .runs = 5 * motions},
      full_in_two(two) && never_full(one), one_does && always_two && in_truth_two_and_one);
}

Claim one_anchor_twice() {
  const Study &one = world(1, 1), &two = world(1, 2);
  const bool turns = are_basis(one.along(), one.courses(), [](const Course& c) -> std::vector<VectorXd> {
    return {turn(c.points[0], c.points[0].anchors)};
  });
  return assessed(
      {.id = "4.1-one-anchor-twice",
       .place = "above (4.21)",
       .statement = "One anchor seen from two different steps is equivalent to two anchors",
       .printed = "equivalent",
       .measured = fmt::format("{}, by anchors: 1: {}; 2: {}. What one leaves is the turn about it: {}",
                               legend, one.numbers(), two.numbers(), turns ? "yes" : "no"),
       .why = "so SOM and TOM say. Turning vehicle and map about the anchor changes no look",
       .runs = 2 * motions},
      one.true_dimension() == two.true_dimension() &&
          dimension(one.stripped(2)) == dimension(two.stripped(2)));
}

Claim range_and_bearing() {
  const auto with = [](int anchors, int segments) -> const Study& {
    return study({.system = "planar-rb", .anchors = anchors, .segments = segments});
  };
  std::vector<std::string> lines;
  for (const int anchors : {0, 1, 2})
    lines.push_back(fmt::format("{}: {}", anchors, with(anchors, 3).numbers()));
  const Study &one = with(1, 3), &at_once = with(2, 1);
  const auto full_at_once = [](const Study& s) {
    return dimension(s.stripped(1)) == 0 && dimension(s.total(1)) == 0;
  };
  const bool in_truth = one.true_dimension() > 0 && at_once.true_dimension() == 0,
             by_matrices = never_full(one) && full_at_once(at_once),
             one_does = never_full(with(0, 3)) && full_at_once(one) && full_at_once(at_once);
  return assessed(
      {.id = "4.1-range-bearing",
       .place = "above (4.21), of [3, 85]",
       .statement = "With range and bearing one segment and two anchors are needed",
       .printed = "one and two",
       .measured = fmt::format("{}, by anchors: {}. The motion itself leaves {} in one segment with two",
                               legend, fmt::join(lines, "; "), joined({at_once.true_dimension()})),
       .why = "so it is for the motion itself. SOM and TOM are content with one anchor in one segment",
       .runs = 4 * motions},
      in_truth && by_matrices, in_truth && one_does);
}

Claim nonlinear_anchors() {
  std::vector<std::string> lines;
  std::vector<int> found;
  for (const int features : {0, 1})
    for (const int anchors : {1, 2}) {
      const int d = dimension(lie({.system = "planar", .features = features, .anchors = anchors}));
      found.push_back(d);
      lines.push_back(fmt::format("{} and {}: {}", features, anchors, joined({d})));
    }
  return assessed(
      {.id = "4.1-nonlinear-anchors",
       .place = "head of Chapter 4, above (4.21), of [11]",
       .statement = "By the nonlinear analysis absolute localisation, with a map or without, takes two "
                    "anchors",
       .printed = "two",
       .measured =
           fmt::format("dimensions left by the Lie derivatives at {} points, features and anchors: {}",
                       motions, fmt::join(lines, "; ")),
       .runs = 4 * motions},
      found == std::vector{1, 0, 1, 0});
}

}  // namespace

std::vector<Claim> anchor_claims() {
  return {range_and_bearing(), nonlinear_anchors(),   anchors_needed(),        one_anchor_twice(),
          anchored_h(),        anchored_null_space(), anchored_two_segments(), anchored_total()};
}

}  // namespace incognita::observability_claims::planar
