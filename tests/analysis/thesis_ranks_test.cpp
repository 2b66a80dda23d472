// The systems of Chapter 4 against ranks from an independent program, and their linearizations.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "incognita/analysis/observability/observability.hpp"
#include "incognita/analysis/systems/symbolic_system.hpp"
#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/analysis/systems/system_instance.hpp"
#include "incognita/analysis/systems/system_motion.hpp"
#include "incognita/io/formats/system_file.hpp"

namespace incognita {
namespace {

/// ranks.csv: from a program in another language, with ranks modulo a prime for the Lie derivatives,
/// complex-step derivatives through an 8th-order integrator for the motion, and the thesis' error forms
/// entered independently for the segments.
struct Ranks {
  std::string representation, motion;
  int features = 0, anchors = 0;
  std::vector<int> som, tom, condition;
  int local = 0, lie = 0;
};

std::vector<int> numbers(const std::string& text) {
  std::istringstream in(text);
  std::vector<int> all;
  for (int n = 0; in >> n;) all.push_back(n);
  return all;
}

std::map<std::string, std::vector<Ranks>> read_ranks() {
  std::ifstream in(INCOGNITA_SOURCE_DIR "/tests/analysis/ranks.csv");
  std::map<std::string, std::vector<Ranks>> all;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::vector<std::string> cell;
    for (std::string one; std::getline(cells, one, ',');) cell.push_back(one);
    all[cell.at(0)].push_back({cell.at(1), cell.at(4), std::stoi(cell.at(2)), std::stoi(cell.at(3)),
                               numbers(cell.at(5)), numbers(cell.at(6)), numbers(cell.at(7)),
                               std::stoi(cell.at(8)), std::stoi(cell.at(9))});
  }
  return all;
}

std::vector<int> stripped(const ObservabilityAnalysis& a) {
  std::vector<int> all;
  for (const SegmentAnalysis& s : a.segments) all.push_back(s.stripped.space.nullity);
  return all;
}

std::vector<int> total(const ObservabilityAnalysis& a) {
  std::vector<int> all;
  for (const SegmentAnalysis& s : a.segments) all.push_back(s.total.space.nullity);
  return all;
}

std::vector<int> condition(const ObservabilityAnalysis& a) {
  std::vector<int> all;
  for (const SegmentAnalysis& s : a.segments) all.push_back(s.condition_holds ? 1 : 0);
  return all;
}

class ThesisSystem : public ::testing::TestWithParam<const char*> {};

TEST_P(ThesisSystem, HasTheRanksOfAnIndependentProgram) {
  const std::vector<Ranks> cases = read_ranks()[GetParam()];
  ASSERT_GE(cases.size(), 12u);
  for (const Ranks& expected : cases) {
    SCOPED_TRACE(expected.representation + ", " + std::to_string(expected.features) + " features, " +
                 std::to_string(expected.anchors) + " anchors, " + expected.motion);
    ObservabilitySettings settings;
    settings.landmarks = expected.features;
    settings.anchors = expected.anchors;
    settings.motion = expected.motion;
    settings.segments = 4;
    const auto a = analyze_observability(load_system(GetParam(), expected.representation), settings);
    EXPECT_EQ(stripped(a), expected.som);
    EXPECT_EQ(total(a), expected.tom);
    EXPECT_EQ(condition(a), expected.condition);
    EXPECT_EQ(a.local.space.nullity, expected.local);
    EXPECT_EQ(a.fisher.space.nullity, expected.local);
    EXPECT_EQ(a.lie->space.nullity, expected.lie);
    EXPECT_TRUE(a.lie->closed);
    EXPECT_FALSE(a.local.space.ambiguous || a.fisher.space.ambiguous || a.lie->space.ambiguous);
    EXPECT_EQ(a.local.directions.size(), static_cast<std::size_t>(expected.local));
  }
}

INSTANTIATE_TEST_SUITE_P(All, ThesisSystem,
                         ::testing::Values("planar", "planar-rb", "planar-cv", "monobot", "inertial",
                                           "inertial-rb", "cv6"));

class BuiltIn : public ::testing::TestWithParam<std::string> {};

TEST_P(BuiltIn, RanksDoNotDependOnTheOperatingPoint) {
  const SystemText text = load_system(GetParam());
  ObservabilitySettings settings;
  settings.lie = false;
  const auto first = analyze_observability(text, settings);
  for (std::uint64_t seed = 2; seed <= 50; ++seed) {
    settings.seed = seed;
    const auto a = analyze_observability(text, settings);
    ASSERT_EQ(stripped(a), stripped(first)) << "seed " << seed;
    ASSERT_EQ(total(a), total(first)) << "seed " << seed;
    ASSERT_EQ(a.local.space.nullity, first.local.space.nullity) << "seed " << seed;
    ASSERT_EQ(a.fisher.space.nullity, first.fisher.space.nullity) << "seed " << seed;
    ASSERT_TRUE(a.doubts.empty()) << "seed " << seed << ": " << a.doubts.front();
  }
}

TEST_P(BuiltIn, LieRanksDoNotDependOnTheOperatingPoint) {
  const SystemText text = load_system(GetParam());
  ObservabilitySettings settings;
  settings.segments = 1;
  const bool large = text.vehicle.states.size() > 5;
  const auto first = analyze_observability(text, settings);
  for (std::uint64_t seed = 2; seed <= (large ? 5u : 50u); ++seed) {
    settings.seed = seed;
    const auto a = analyze_observability(text, settings);
    ASSERT_EQ(a.lie->space.nullity, first.lie->space.nullity) << "seed " << seed;
    ASSERT_EQ(a.lie->order, first.lie->order) << "seed " << seed;
  }
}

TEST_P(BuiltIn, JacobiansAreDerivativesOfTheEquations) {
  const SymbolicSystem system = make_symbolic(load_system(GetParam()));
  const SystemInstance instance(system, 2, system.text.anchor ? 1 : 0);
  RandomStream random(7, "derivatives");
  for (int trial = 0; trial < 5; ++trial) {
    const SystemPoint point = draw_motion(instance, 1, random).segments.front().start;
    const LinearizedSystem exact = instance.linearize(point);
    for (int column = 0; column < instance.states(); ++column) {
      const double step = 1e-6;
      SystemPoint up = point, down = point;
      up.x[column] += step;
      down.x[column] -= step;
      const Eigen::VectorXd difference = (instance.rate(up) - instance.rate(down)) / (2 * step);
      EXPECT_LT((exact.F.col(column) - difference).norm(), 1e-7 * (1 + difference.norm()))
          << instance.names()[column];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BuiltIn, ::testing::ValuesIn(built_in_systems()), [](const auto& one) {
  std::string name = one.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

/// Transformation from errors of Euler angles to misalignment about world axes: psi = C' E^-1 dPsi, with the
/// inverse of (4.28).
Eigen::MatrixXd misalignment(const SystemInstance& instance, const SystemPoint& point) {
  const auto& names = instance.names();
  const auto first = std::find(names.begin(), names.end(), "phi") - names.begin();
  const double phi = point.x[first], theta = point.x[first + 1], psi = point.x[first + 2];
  const double cf = std::cos(phi), sf = std::sin(phi), ct = std::cos(theta), st = std::sin(theta),
               cp = std::cos(psi), sp = std::sin(psi);
  Eigen::Matrix3d C, to_body;
  C << cp * ct, sp * ct, -st, cp * st * sf - sp * cf, sp * st * sf + cp * cf, ct * sf, cp * st * cf + sp * sf,
      sp * st * cf - cp * sf, ct * cf;
  to_body << 1, 0, -st, 0, cf, sf * ct, 0, -sf, cf * ct;
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(instance.states(), instance.states());
  T.block<3, 3>(first, first) = C.transpose() * to_body;
  return T;
}

class ErrorForm : public ::testing::TestWithParam<const char*> {};

TEST_P(ErrorForm, IsTheSameSystemInOtherCoordinates) {
  const SymbolicSystem system = make_symbolic(load_system(GetParam()));
  const SystemInstance instance(system, 2, system.text.anchor ? 2 : 0);
  RandomStream random(8, "error form");
  for (int trial = 0; trial < 5; ++trial) {
    const SystemPoint point = draw_motion(instance, 1, random).segments.front().start;
    const LinearizedSystem exact = instance.linearize(point), error = instance.error_form(point);
    const Eigen::MatrixXd T = misalignment(instance, point);
    EXPECT_LT((error.H * T - exact.H).norm(), 1e-12 * exact.H.norm());
    // e = T dx, so that e' = (T' + T F) T^-1 e, with T' along the motion
    SystemPoint ahead = point, behind = point;
    const double step = 1e-6;
    ahead.x += step * instance.rate(point);
    behind.x -= step * instance.rate(point);
    const Eigen::MatrixXd T_rate =
        (misalignment(instance, ahead) - misalignment(instance, behind)) / (2 * step);
    const Eigen::MatrixXd F = (T_rate + T * exact.F) * T.inverse();
    EXPECT_LT((error.F - F).norm(), 1e-8 * F.norm()) << error.F - F;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ErrorForm,
                         ::testing::Values("inertial", "inertial-relative", "inertial-rb",
                                           "inertial-rb-relative", "cv6"));

}  // namespace
}  // namespace incognita
