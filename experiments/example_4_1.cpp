// Example 4.1: observability of a planar vehicle with a camera, and of features. World-centric
// here; with anchors in example_4_1_anchors.cpp, the relative map in example_4_1_relative.cpp.
//
// Experiment: the built-in system `planar`, motions and rules of observability_claims.hpp; 1 to 3 features,
// up to 5 segments; also turning on the spot, and with the feature anywhere, straight ahead or abeam. Holds:
// beside those rules, matrices to 1e-9.
#include "experiments/example_4_1.hpp"
#include "experiments/common.hpp"

namespace incognita::observability_claims::planar {
namespace {

/// Where the motion begins: speed, heading's cosine and sine, and the feature from the vehicle.
struct Begin {
  double v, c, s;
  Vector2d r;
  explicit Begin(const Course& course)
      : v(course.points[0].u[0]),
        c(std::cos(course.points[0].x[2])),
        s(std::sin(course.points[0].x[2])),
        r(r_of(course.points[0])) {}
};

std::vector<Claim> matrices() {
  const double of_form = largest(world(), [](const Course& course) {
    const auto [v, c, s, r] = Begin(course);
    MatrixXd F = MatrixXd::Zero(5, 5);
    F(0, 2) = -v * s, F(1, 2) = v * c;
    const VectorXd H = five(r.y(), -r.x(), -r.squaredNorm(), -r.y(), r.x()) / r.squaredNorm();
    return std::max(apart(course.exact[0].F, F), apart(course.exact[0].H, H.transpose()));
  });
  const double of_rows = largest(world(), [](const Course& course) {
    const auto [v, c, s, r] = Begin(course);
    const VectorXd printed = five(0, 0, (-r.y() * v * s - r.x() * v * c) / r.squaredNorm(), 0, 0);
    const MatrixXd &F = course.forms[0].F, &H = course.forms[0].H;
    return std::max(apart(H * F, printed.transpose()), (H * F * F).cwiseAbs().maxCoeff());
  });
  return {studied("4.1-F-H", "(4.14), (4.15)",
                  "F and H of the error form are the derivatives of (4.11) and (4.12), to 1e-9",
                  {.measured = {"largest difference in {} motions {}", motions, below(of_form)}},
                  of_form < rounding),
          studied("4.1-Q1", "(4.16), footnote 1",
                  "Q_1 is H and one row H F, which has but a heading; higher powers are zero; to 1e-9",
                  {.printed = "(-r_y v sin - r_x v cos)/d^2",
                   .measured = {"largest difference in {} motions {}", motions, below(of_rows)}},
                  of_rows < rounding)};
}

Claim f_null_space() {
  const Spaces spaces = null_spaces(world(), [](const Course& c) { return c.forms[0].F; });
  const MatrixXd I = MatrixXd::Identity(5, 5);
  const bool basis = are_basis(spaces, world().courses(), always({I.col(0), I.col(1), I.col(3), I.col(4)}));
  const bool one = for_all({1, 2, 3}, [](int k) { return world().same_spaces(k); });
  return studied("4.1-F-null-space", "(4.19), (4.9)",
                 "N(F_j) is all but the heading and contains N(Q_j), so that TOM and SOM have one null space",
                 {.printed = "dimension 4",
                  .measured = {"dimension {}; (4.9) holds in {} segments; null spaces of SOM and TOM after "
                               "1, 2, 3 segments are {}",
                               dimension(spaces), world().stays() ? "all" : "not all",
                               one ? "the same" : "not the same"}},
                 basis && world().stays() && one);
}

Basis vectors_4_17(const Course& c) {
  const Vector2d r = r_of(c.points[0]);
  return {five(r.x(), r.y(), 0, 0, 0), five(1, 0, 0, 1, 0), five(-r.x(), 0, 0, 0, r.y())};
}

std::vector<Claim> one_segment() {
  const Study& s = world();
  const bool basis = s.stripped_spanned_by(1, vectors_4_17);
  const auto in_segment = s.observable(1), along = s.observable_along();
  const std::vector<std::string> heading{"theta"};
  return {
      studied("4.1-instant-null-space", "(4.17)",
              "Null space of one segment, with nothing of the heading in it",
              {.printed = "dimension 3",
               .measured = {"dimension {} of 5 in {} motions; the printed vectors span it: {}", s.left(1),
                            motions, yes_no(basis)}},
              basis),
      studied(
          "4.1-orientation", "below (4.17), Section 4.4",
          "The vehicle's orientation is the only completely observable state, as long as it moves",
          {.printed = "orientation",
           .measured = {"states outside the null space in {} motions: of Q_1 {}; of the motion itself {}. "
                        "All turned about a point is in its null space: {}",
                        motions, listed(in_segment), listed(along),
                        yes_no(s.along_contains(named({"rotation"})))},
           .why = "so it is by Q_1, in which F moves the vehicle while H is frozen. Turning vehicle and map "
                  "about a point changes no measurement, so that no motion makes the heading observable"},
          in_segment == heading && along == heading)};
}

Claim at_rest() {
  const Study& s = study({.system = "planar", .motion = "stationary", .change = turning()});
  const auto vectors = [](double sign) {
    return [sign](const Course& c) -> Basis {
      const Vector2d r = r_of(c.points[0]);
      return {five(-r.x(), -r.y(), 0, 0, 0), five(r.x(), 0, 0, 0, -r.y()), five(1, 0, 0, 1, 0),
              five(r.squaredNorm(), 0, sign * r.y(), 0, 0)};
    };
  };
  const bool printed = s.stripped_spanned_by(1, vectors(-1)),
             corrected = s.stripped_spanned_by(1, vectors(1));
  const auto seen = s.observable(1);
  return studied("4.1-standing", "(4.18)",
                 "At rest the null space has dimension 4, and the heading is not observable either",
                 {.printed = "4th vector [d^2 0 -r_y 0 0]",
                  .measured = {"{} (turning on the spot); states outside the null space: {}. The 4th vector "
                               "is {} with -r_y, {} with r_y",
                               s.text(), listed(seen), printed ? "in it" : "not in it",
                               corrected ? "in it" : "not in it"},
                  .why = "[d^2 0 r_y 0 0]"},
                 printed && seen.empty(), corrected && seen.empty() && s.true_dimension() == 4);
}

MatrixXd row_HF(const Course& course) { return course.forms[0].H * course.forms[0].F; }

/// How far the row H F is from -v r_x/d^2 in the column of a heading that is 0, and nothing else.
double wrong_row(const Study& s) {
  return largest(s, [](const Course& course) {
    const auto [v, cos, sin, r] = Begin(course);
    return apart(row_HF(course), five(0, 0, -v * r.x() / r.squaredNorm(), 0, 0).transpose());
  });
}

Claim anywhere() {
  const auto feature = [](const std::string& name, const Vector2d& ahead,
                          const Vector2d& left) -> const Study& {
    return study({.system = "planar", .change = feature_within(name, ahead, left)});
  };
  const Study &around = feature("around", {-9, 9}, {-9, 9}), &ahead = feature("ahead", {3, 9}, {0, 0}),
              &abeam = feature("abeam", {0, 0}, {3, 9});
  const int d[] = {around.left(1), ahead.left(1), abeam.left(1)};
  const int of_4_17 = span(ahead.courses(), vectors_4_17);
  const double abeam_row = largest(abeam, [](const Course& c) { return row_HF(c).cwiseAbs().maxCoeff(); });
  const double row = std::max({wrong_row(around), wrong_row(ahead), wrong_row(abeam)});
  const bool falls_short = of_4_17 == 2 && contain(ahead.stripped(1), ahead.courses(), vectors_4_17),
             row_is_so = row < rounding && abeam_row < rounding;
  return studied(3, "4.1-anywhere", "below (4.18)",
                 "One segment leaves three modes wherever the feature is, except on the optical axis",
                 {.printed = "except r_y = 0",
                  .measured = {"N(Q_1) in {} motions each, vehicle heading along x: feature anywhere {}, "
                               "straight ahead {}, where (4.17) has {} independent vectors, abeam {}, where "
                               "the row H F is {}. That row differs from [0 0 -v r_x/d^2 0 0] by {}",
                               motions, joined({d[0]}), joined({d[1]}), joined({of_4_17}), joined({d[2]}),
                               below(abeam_row), below(row)},
                  .why = "except abeam, r_x = 0: there the row H F, -v r_x/d^2, is zero. Straight ahead it "
                         "is (4.17) that falls short, as its vectors become two"},
                 d[0] == 3 && d[1] != 3 && d[1] != no_dimension && d[2] == 3,
                 d[0] == 3 && d[1] == 3 && d[2] == 4 && falls_short && row_is_so);
}

const Vectors translations = named({"translation"});

std::vector<Claim> more_segments() {
  const Study& one = world();
  const bool basis = one.stripped_spanned_by(2, translations);
  const Cases of_five = by_number({1, 2, 3}, [](int features) -> CaseResult {
    const Study& s = world(features, 0, 5);
    return {s.segments_text(),
            for_all({2, 3, 4, 5}, [&](int k) { return s.stripped_spanned_by(k, translations); })};
  });
  const Studies maps = by_features({1, 2, 3}, {.system = "planar"});
  const Cases modes = by_number({1, 2, 3}, [](int features) -> CaseResult {
    const Study& s = world(features);
    return {joined({s.true_dimension()}), s.along_spanned_by(translations)};
  });
  const bool corrected = maps.all([](const Study& s) {
    return s.along_spanned_by(named({"translation", "rotation"})) && s.left(3) == 2 &&
           dimension(s.total(3)) == 2;
  });
  return {studied("4.1-two-segments", "(4.20)",
                  "Null space of the SOM of two segments: the two translations of vehicle and feature",
                  {.printed = "dimension 2",
                   .measured = {"{}, in {} motions; the printed vectors span it: {}", one.text(), motions,
                                yes_no(basis)}},
                  basis),
          studied(3, "4.1-more", "below (4.20)",
                  "More features or segments do not change the null space of the SOM: two translations",
                  {.printed = "dimension 2",
                   .measured = "dimensions left by SOM and TOM after 1/2/3/4/5 segments, by features: " +
                               of_five.text()},
                  of_five.hold()),
          studied(3, "4.1-modes", "below (4.20)",
                  "The system's unobservable modes are the two translations of vehicle and map, for any "
                  "number of features",
                  {.printed = "2",
                   .measured = "dimensions left by the motion itself, by features: " + modes.text(),
                   .why = "three: these and the turn of all about a point. SOM and TOM leave two, because H "
                          "is frozen within a segment"},
                  modes.hold(), corrected)};
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(example_4_1, settings,
                  {matrices(), one_segment(), at_rest(), anywhere(), f_null_space(), more_segments(),
                   anchor_claims(), relative_claims()});
}

}  // namespace
}  // namespace incognita::observability_claims::planar

const incognita::Experiment incognita::example_4_1{
    "4.1", "Bearings for a planar vehicle", {}, observability_claims::planar::run};
