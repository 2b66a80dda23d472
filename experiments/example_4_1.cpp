// Example 4.1: observability of a planar vehicle with a camera, and of features. World-centric
// here; with anchors in example_4_1_anchors.cpp, the relative map in example_4_1_relative.cpp.
//
// Experiment: the built-in system `planar`, motions and rules of observability_claims.hpp; 1 to 3 features,
// up to 5 segments; also turning on the spot, and with the feature anywhere, straight ahead or abeam, turning
// or straight on. Holds: beside those rules, matrices to 1e-9.
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
                  {.printed = "-(r_y/d^2) v_r sin theta - (r_x/d^2) v_r cos theta",
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
                 {.rule = Rule::dimension,
                  .measured = {"dimension {}; (4.9) holds in {} segments; null spaces of SOM and TOM after "
                               "1, 2, 3 segments are {}",
                               dimension(spaces), world().stays() ? "all" : "not all",
                               one ? "the same" : "not the same"},
                  .number = number_of("dimension of N(F_j), of 5", dimension(spaces))},
                 basis && world().stays() && one);
}

Basis vectors_4_17(const Course& c) {
  const Vector2d r = r_of(c.points[0]);
  return {five(r.x(), r.y(), 0, 0, 0), five(1, 0, 0, 1, 0), five(-r.x(), 0, 0, 0, r.y())};
}

const Vectors translations = named({"translation"}), turn = named({"rotation"});

std::vector<Claim> one_segment() {
  const Study& s = world();
  const bool basis = s.stripped_spanned_by(1, vectors_4_17), frozen = seen_by_frozen_rows_only(s, turn);
  const auto in_segment = s.observable(1), along = s.observable_along();
  const std::vector<std::string> heading{"theta"};
  return {
      studied("4.1-instant-null-space", "(4.17)",
              "The three vectors of (4.17), with nothing of the heading in them, span the null space of Q_1",
              {.rule = Rule::dimension,
               .measured = {"dimension {} of 5 in {} motions; the printed vectors span it: {}", s.left(1),
                            motions, yes_no(basis)},
               .number = number_of("dimension of N(Q_1), of 5", s.left(1))},
              basis && in_segment == heading),
      studied(
          "4.1-orientation", "below (4.17), Sections 4.4 and 7.1",
          "The vehicle's orientation is the only completely observable state, as long as it moves",
          {.rule = Rule::dimension,
           .measured = {"states outside the null space in {} motions: of Q_1 {}; of the motion itself {}. "
                        "A turn of all is in the null space of the motion: {}; only the row H F sees it: "
                        "{}",
                        motions, listed(in_segment), listed(along), yes_no(s.along_contains(turn)),
                        yes_no(frozen)},
           .number =
               exactly("states that the motion itself makes observable", static_cast<double>(along.size())),
           .why = "no state is. Turning vehicle and map about a point changes no measurement, so that no "
                  "motion makes the heading observable. Q_1 has it by the row H F, in which H is frozen"},
          InTruth{along == heading, in_truth(along.empty() && s.along_contains(turn) && frozen)},
          ByMethod{in_segment == heading})};
}

std::vector<Claim> at_rest() {
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
  const auto in_segment = s.observable(1), along = s.observable_along();
  return {studied("4.1-standing", "(4.18)", "The four vectors of (4.18) span the null space of Q_1 at rest",
                  {.rule = Rule::dimension,
                   .printed = "4th vector [d^2 0 -r_y 0 0]",
                   .measured = {"dimension {} in {} motions (turning on the spot). The 4th vector is {} with "
                                "-r_y, {} with r_y",
                                s.left(1), motions, printed ? "in it" : "not in it",
                                corrected ? "in it" : "not in it"},
                   .number = number_of("dimension of N(Q_1) at rest, of 5", s.left(1)),
                   .why = "[d^2 0 r_y 0 0]"},
                  printed, as_corrected(corrected)),
          studied("4.1-standing-orientation", "above (4.18)",
                  "At rest four modes are left, and the orientation is not observable either",
                  {.rule = Rule::dimension,
                   .measured = {"{} (turning on the spot); states outside the null space: of Q_1 {}, of the "
                                "motion itself {}",
                                s.text(), listed(in_segment), listed(along)},
                   .number = left_in_truth(s, ", at rest")},
                  InTruth{s.true_dimension() == 4 && along.empty()},
                  ByMethod{s.left(1) == 4 && s.left(3) == 4 && in_segment.empty()})};
}

MatrixXd row_HF(const Course& course) { return course.forms[0].H * course.forms[0].F; }

/// How far the row H F is from -v r_x/d^2 in the column of a heading that is 0, and nothing else.
double wrong_row(const Study& s) {
  return largest(s, [](const Course& course) {
    const auto [v, cos, sin, r] = Begin(course);
    return apart(row_HF(course), five(0, 0, -v * r.x() / r.squaredNorm(), 0, 0).transpose());
  });
}

/// One segment with the feature somewhere, the vehicle heading along x.
const Study& feature_at(const std::string& name, const Vector2d& ahead, const Vector2d& left,
                        const std::string& motion = "general") {
  return study(
      {.system = "planar", .motion = motion, .change = feature_within(name, ahead, left), .segments = 1});
}

Claim anywhere() {
  const Study &around = feature_at("around", {-9, 9}, {-9, 9}), &ahead = feature_at("ahead", {3, 9}, {0, 0}),
              &abeam = feature_at("abeam", {0, 0}, {3, 9}),
              &straight_at = feature_at("ahead", {3, 9}, {0, 0}, "straight");
  const int d[] = {around.left(1), ahead.left(1), abeam.left(1)},
            truly[] = {around.true_dimension(), ahead.true_dimension(), abeam.true_dimension(),
                       straight_at.true_dimension()};
  const int of_4_17 = span(ahead.courses(), vectors_4_17);
  const double abeam_row = largest(abeam, [](const Course& c) { return row_HF(c).cwiseAbs().maxCoeff(); });
  const double row = std::max({wrong_row(around), wrong_row(ahead), wrong_row(abeam)});
  const bool falls_short = of_4_17 == 2 && contain(ahead.stripped(1), ahead.courses(), vectors_4_17),
             row_is_so = row < rounding && abeam_row < rounding;
  return studied(
      4, "4.1-anywhere", "below (4.18)",
      "One segment leaves three modes wherever the feature is, except straight ahead (r_y = 0)",
      {.rule = Rule::dimension,
       .measured =
           {"left by Q_1 in {} motions each, heading along x: feature anywhere {}, straight ahead {}, "
            "abeam {}, where H F is {}; (4.17) has {} independent vectors straight ahead. By the "
            "motion itself: {}, {}, {}; straight at the feature {}",
            motions, joined({d[0]}), joined({d[1]}), joined({d[2]}), below(abeam_row), joined({of_4_17}),
            joined({truly[0]}), joined({truly[1]}), joined({truly[2]}), joined({truly[3]})},
       .number = left_in_truth(straight_at, ", straight at the feature for one segment"),
       .why = "if it drives straight at the feature, so that r_y remains 0. Q_1 has its exception abeam "
              "instead, r_x = 0, where the row H F, -v r_x/d^2, is zero; straight ahead (4.17) falls short, "
              "as its vectors become two"},
      InTruth{truly[0] == 3 && truly[1] > 3 && truly[2] == 3,
              on_condition(truly[0] == 3 && truly[1] == 3 && truly[2] == 3 && truly[3] == 4)},
      ByMethod{d[0] == 3 && d[1] != 3 && d[1] != no_dimension && d[2] == 3,
               in_truth(d[0] == 3 && d[1] == 3 && d[2] == 4 && falls_short && row_is_so)});
}

std::vector<Claim> more_segments() {
  const Study& one = world();
  const bool basis = one.stripped_spanned_by(2, translations);
  const auto spanned_from_two = [](int features) {
    const Study& s = world(features, 0, 5);
    return for_all({2, 3, 4, 5}, [&](int k) { return s.stripped_spanned_by(k, translations); });
  };
  const Cases of_five = by_number({1, 2, 3}, [&](int features) -> CaseResult {
    return {world(features, 0, 5).segments_text(), spanned_from_two(features)};
  });
  const Studies maps = by_features({1, 2, 3}, {.system = "planar"});
  return {
      studied("4.1-two-segments", "(4.20)",
              "The two translations of vehicle and feature span the null space of the SOM of two segments",
              {.rule = Rule::dimension,
               .measured = {"{}, in {} motions; the printed vectors span it: {}", one.text(), motions,
                            yes_no(basis)},
               .number = number_of("dimension of N(Q_SOM) of two segments, of 5", one.left(2))},
              basis),
      studied(3, "4.1-more", "below (4.20)",
              "More features or segments do not change the null space of the SOM: two translations",
              {.rule = Rule::dimension,
               .measured =
                   "dimensions left by SOM and TOM after 1/2/3/4/5 segments, by features: " + of_five.text(),
               .number = number_of("dimension of N(Q_SOM) of five segments with three features",
                                   world(3, 0, 5).left(5))},
              of_five.hold()),
      studied(3, "4.1-modes", "below (4.20)",
              "The system's unobservable modes are the two translations of vehicle and map, for any "
              "number of features",
              {.rule = Rule::dimension,
               .measured = maps.text(),
               .number = left_in_truth(one),
               .why = "three: these and the turn of all about a point. SOM and TOM lack it, because H is "
                      "frozen within a segment"},
              InTruth{maps.all([](const Study& s) { return s.along_spanned_by(translations); }),
                      in_truth(maps.all([](const Study& s) {
                        return s.along_spanned_by(named({"translation", "rotation"})) &&
                               seen_by_frozen_rows_only(s, turn);
                      }))},
              ByMethod{for_all({1, 2, 3}, spanned_from_two)})};
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
