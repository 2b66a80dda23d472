// Comparison of printed with computed null spaces, on matrices with obvious null spaces; the motions are
// those of `incognita observe`.
#include "experiments/observability_claims.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/example_4_2.hpp"
#include "incognita/analysis/observability/observability.hpp"
#include "incognita/io/formats/system_file.hpp"

namespace incognita::observability_claims {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Null space of the rows.
NullSpace of(const MatrixXd& rows) { return null_space(NoisyRows::exact(rows)); }

/// Measures the difference of the first two coordinates only.
MatrixXd difference() { return (MatrixXd(1, 3) << 1, -1, 0).finished(); }

const std::vector<Course> two_courses(2);

Vectors vectors(const std::vector<VectorXd>& all) {
  return [all](const Course&) { return all; };
}

TEST(SpacesTest, DimensionIsTheCommonOne) {
  EXPECT_EQ(dimension({of(difference()), of(difference())}), 2);
  EXPECT_EQ(dimension({of(difference()), of(MatrixXd::Identity(3, 3))}), no_dimension);
  EXPECT_EQ(dimension({}), no_dimension);
  NullSpace doubtful = of(difference());
  doubtful.ambiguous = true;
  EXPECT_EQ(dimension({of(difference()), doubtful}), no_dimension);
}

TEST(SpacesTest, BasisIsContainedIndependentAndComplete) {
  const Spaces spaces(2, of(difference()));
  const VectorXd a = Vector3d(1, 1, 0), b = Vector3d(2, 2, 5), outside = Vector3d(1, 0, 0);
  EXPECT_TRUE(are_basis(spaces, two_courses, vectors({a, b})));
  EXPECT_TRUE(contain(spaces, two_courses, vectors({a})));
  EXPECT_FALSE(are_basis(spaces, two_courses, vectors({a})));
  EXPECT_FALSE(are_basis(spaces, two_courses, vectors({a, -3 * a})));
  EXPECT_FALSE(are_basis(spaces, two_courses, vectors({a, b, a + b})));
  EXPECT_FALSE(contain(spaces, two_courses, vectors({a, outside})));
  EXPECT_FALSE(are_basis(spaces, two_courses, vectors({a, outside})));
  EXPECT_FALSE(contain(spaces, two_courses, vectors({a, VectorXd::Zero(3)})));
  EXPECT_FALSE(contain({}, {}, vectors({})));
}

TEST(SpacesTest, ABasisMustBeInTheNullSpaceOfEveryMotion) {
  const Spaces spaces{of(difference()), of(Vector3d(1, 1, 0).transpose())};
  EXPECT_FALSE(are_basis(spaces, two_courses, vectors({Vector3d(1, 1, 0), Vector3d(0, 0, 1)})));
  EXPECT_TRUE(contain(spaces, two_courses, vectors({Vector3d(0, 0, 1)})));
}

TEST(SpacesTest, SpanCountsIndependentVectors) {
  const VectorXd a = Vector3d(1, 1, 0), b = Vector3d(0, 0, 1e4);
  EXPECT_EQ(span(two_courses, vectors({a, b, a + b})), 2);
  EXPECT_EQ(span(two_courses, vectors({a, -3 * a})), 1);
  EXPECT_EQ(span(two_courses, vectors({})), no_dimension);
  EXPECT_EQ(span({}, vectors({a})), no_dimension);
  bool first = false;
  const auto differing = [&](const Course&) { return std::vector<VectorXd>{a, (first = !first) ? a : b}; };
  EXPECT_EQ(span(two_courses, differing), no_dimension);
}

TEST(SpacesTest, DimensionsWithinSomeStates) {
  const Spaces spaces(2, of(difference()));  // x and y together, and z
  EXPECT_EQ(dimension_within(spaces, 0, 2), 1);
  EXPECT_EQ(dimension_within(spaces, 2, 1), 1);
  EXPECT_EQ(dimension_within(spaces, 0, 3), 2);
  EXPECT_EQ(dimension_within({of(MatrixXd::Identity(3, 3))}, 0, 3), 0);
  EXPECT_EQ(dimension_within({of(difference()), of(MatrixXd::Identity(3, 3))}, 0, 2), no_dimension);
}

TEST(SpacesTest, EqualSpacesHaveMoreThanEqualDimensions) {
  const NullSpace one = of(difference()), other = of(Vector3d(1, 1, 0).transpose());
  EXPECT_TRUE(same({one}, {of(-7 * difference())}));
  EXPECT_FALSE(same({one}, {other}));
  EXPECT_FALSE(same({one}, {of(MatrixXd::Identity(3, 3))}));
  EXPECT_FALSE(same({one}, {one, one}));
}

TEST(SpacesTest, StatesObservableInSomeMotionsAreQuestionable) {
  MatrixXd third(2, 3);
  third << 1, -1, 0, 0, 0, 1;
  const std::vector<std::string> names{"x", "y", "z"};
  EXPECT_EQ(observable_states({of(third), of(third)}, names), std::vector<std::string>{"z"});
  EXPECT_EQ(observable_states({of(third), of(difference())}, names), std::vector<std::string>{"z?"});
  EXPECT_TRUE(observable_states({of(difference())}, names).empty());
}

TEST(SpacesTest, Texts) {
  EXPECT_EQ(joined({3, 2, 2}), "3/2/2");
  EXPECT_EQ(joined({3, no_dimension}), "3/not the same in all");
  EXPECT_EQ(listed({}), "none");
  EXPECT_EQ(listed({"x"}), "x");
  EXPECT_EQ(listed({"x", "y", "z"}), "x, y and z");
}

TEST(StudyTest, EqualsObserveOnTheSameMotions) {
  const Study& s = study({.system = "planar-cv", .anchors = 1});
  ASSERT_EQ(s.courses().size(), std::size_t{motions});
  for (const int seed : {1, 7}) {
    ObservabilitySettings settings;
    settings.anchors = 1;
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.lie = false;
    const ObservabilityAnalysis analysis = analyze_observability(load_system("planar-cv"), settings);
    const Course& course = s.courses()[static_cast<std::size_t>(seed - 1)];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(course.points[k].x, analysis.points[k].x);
      EXPECT_EQ(s.dimensions()[k], analysis.segments[k].stripped.space.nullity);
      EXPECT_EQ(s.total_dimensions()[k], analysis.segments[k].total.space.nullity);
    }
    EXPECT_EQ(s.true_dimension(), analysis.local.space.nullity);
  }
  EXPECT_EQ(s.numbers(), "4/1/0 and 2");
  EXPECT_EQ(s.text(), "SOM and TOM leave 4/1/0 dimensions after 1/2/3 segments, the motion itself 2");
}

TEST(StudyTest, ChangesAreAppliedSeparately) {
  const Change still{"still", [](SystemText& text) { text.inputs.at(0).low = text.inputs.at(0).high = 0; }};
  const Study &moving = study({.system = "planar"}), &standing = study({.system = "planar", .change = still});
  EXPECT_EQ(moving.dimensions(), (std::vector{3, 2, 2}));
  EXPECT_EQ(standing.dimensions(), (std::vector{4, 4, 4}));
  EXPECT_EQ(&moving, &study({.system = "planar"}));
}

TEST(StudyTest, RefusesMatricesOfTheWrongSystem) {
  const Study& s = study({.system = "planar"});
  const Spaces as_it_is = stripped_with(s, 2, [](LinearizedSystem&, const SystemPoint&) {}),
               blind =
                   stripped_with(s, 2, [](LinearizedSystem&form, const SystemPoint&) { form.F.setZero(); });
  EXPECT_TRUE(same(as_it_is, s.stripped(2)));
  EXPECT_FALSE(same(blind, s.stripped(2)));
}

TEST(StudyTest, OnlyFrozenRowsSeeATurn) {
  const Study &world = study({.system = "planar"}), &anchored = study({.system = "planar", .anchors = 1}),
              &map = study(relative_map("inertial"));
  EXPECT_TRUE(seen_by_frozen_rows_only(world, named({"rotation"})));
  EXPECT_TRUE(seen_by_frozen_rows_only(anchored, about_anchor({"rotation"})));
  EXPECT_TRUE(seen_by_frozen_rows_only(map, named({"rotation about z"})));
  EXPECT_FALSE(seen_by_frozen_rows_only(world, named({"translation"})));  // nothing sees it
  EXPECT_FALSE(seen_by_frozen_rows_only(world, named({"depth"})));        // the motion sees it
  EXPECT_FALSE(seen_by_frozen_rows_only(anchored, named({"rotation"})));  // the anchor does
}

TEST(StudyTest, ClaimsOfASystemHaveTwoFindings) {
  const Claim both = studied("some", "", "", {.measured = "", .why = "because"},
                             InTruth{false, in_truth(true)}, ByMethod{false, on_condition(true)});
  EXPECT_EQ(both.finding, Finding::does_not_hold);
  EXPECT_EQ(both.by_method, Finding::holds_if);
  EXPECT_EQ(both.why, "because");
  EXPECT_EQ(both.runs, motions);
  const Claim opposite = studied(3, "some", "", "", {}, InTruth{true}, ByMethod{false});
  EXPECT_EQ(opposite.finding, Finding::holds);
  EXPECT_EQ(opposite.by_method, Finding::does_not_hold);
  EXPECT_EQ(opposite.runs, 3 * motions);
  EXPECT_FALSE(studied("some", "", "", {}, true).by_method);
}

TEST(StudyTest, NoNumberWhereMotionsDisagree) {
  EXPECT_EQ(number_of("left", 2)->value.value, 2);
  EXPECT_FALSE(number_of("left", no_dimension));
}

/// Largest difference of F and H, transformed to misalignments from exact derivatives, from those of the
/// error form.
double apart_from_error_form(const Case& which, Eigen::Index angles,
                             const std::function<Vector3d(const SystemPoint&)>& rate) {
  return largest(study(which), [&](const Course& c) {
    const SystemPoint& p = c.points[0];
    const auto made = inertial::misaligned(c.exact[0], p.x.segment<3>(angles), angles, rate(p));
    return std::max(apart(made.F, c.forms[0].F), apart(made.H, c.forms[0].H));
  });
}

TEST(MisalignedTest, ExactDerivativesEqualTheErrorForm) {
  const auto measured = [](const SystemPoint& p) -> Vector3d { return p.u.tail<3>(); };
  const auto state = [](const SystemPoint& p) -> Vector3d { return p.x.segment<3>(9); };
  EXPECT_LT(apart_from_error_form(inertial::world(1, 2), 6, measured), 1e-10);
  EXPECT_LT(apart_from_error_form(inertial::relative(2), 3, measured), 1e-10);
  EXPECT_LT(apart_from_error_form({.system = "cv6", .anchors = 1, .segment_s = in_space_s}, 6, state), 1e-10);
  const auto none = [](const SystemPoint&) -> Vector3d { return Vector3d::Zero(); };
  EXPECT_GT(apart_from_error_form(inertial::world(), 6, none), 1e-3);
}

TEST(MisalignedTest, BearingsHaveTheirDerivatives) {
  const Vector3d s(3, -2, 1.5);
  const auto measurement = [](const Vector3d& at) {
    return Eigen::Vector2d(std::atan2(at.y(), at.x()), std::atan2(at.z(), at.head<2>().norm()));
  };
  constexpr double h = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = h * Vector3d::Unit(axis);
    const Eigen::Vector2d slope = (measurement(s + step) - measurement(s - step)) / (2 * h);
    EXPECT_LT((inertial::bearings_by(s).col(axis) - slope).norm(), 1e-9);
  }
}

TEST(StudyTest, LieDerivativesAtTheStartOfTheMotions) {
  const Spaces spaces = lie({.system = "planar", .representation = "relative"}, 3);
  ASSERT_EQ(spaces.size(), 3U);
  EXPECT_EQ(dimension(spaces), 1);
}

}  // namespace
}  // namespace incognita::observability_claims
