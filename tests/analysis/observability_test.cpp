// Properties of the observability analysis of any system.
#include "incognita/analysis/observability/observability.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/systems/symbolic_system.hpp"
#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/io/formats/system_file.hpp"
#include "tests/analysis/remarks.hpp"

namespace incognita {
namespace {

using testing::remarks;
using testing::says;

SystemText drone() { return load_system(INCOGNITA_SOURCE_DIR "/docs/systems/drone.toml"); }

TEST(Observability, AnalyzesASystemOfAUser) {
  ObservabilitySettings settings;
  settings.landmarks = 2;
  const auto a = analyze_observability(drone(), settings);
  EXPECT_EQ(a.local.space.nullity, 3) << "beacons and drone can be moved together";
  EXPECT_EQ(a.lie->space.nullity, 3);
  const Eigen::VectorXd shift = (Eigen::VectorXd(9) << 1, 0, 0, 1, 0, 0, 1, 0, 0).finished();
  EXPECT_TRUE(a.local.space.contains(shift));
}

TEST(Observability, AcceptsInputsThatEnterNonlinearly) {
  // An Ackermann car: the steering angle is the argument of a tangent
  SystemText car = load_system("planar");
  car.inputs[1] = {"steer", {}, -0.5, 0.5};
  car.vehicle.states[2].expression.text = "v*tan(steer)/2";
  car.motions.clear();
  const auto a = analyze_observability(car, {});
  EXPECT_TRUE(a.lie->inputs_nonlinear);
  EXPECT_EQ(a.lie->space.nullity, 3);
  EXPECT_EQ(a.local.space.nullity, 3);
}

TEST(Observability, NamesUnobservableDirections) {
  const auto a = analyze_observability(load_system("cv6"), {.landmarks = 2, .lie = false});
  std::vector<std::string> names;
  for (const auto& d : a.local.directions) names.push_back(d.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"translation along x", "translation along y", "translation along z",
                                      "rotation about x", "rotation about y", "rotation about z", "scale"}));
  const auto still = analyze_observability(load_system("planar"), {.anchors = 2, .motion = "stationary"});
  ASSERT_EQ(still.local.directions.size(), 2u);
  EXPECT_EQ(still.local.directions[0].name, "depth of feature 1");
}

TEST(Observability, ReportsDisagreeingMethodsWithTheReason) {
  const auto a = analyze_observability(load_system("planar"), {.anchors = 1});
  ASSERT_FALSE(a.disagreements.empty());
  EXPECT_NE(a.disagreements.front().find("keeps H constant"), std::string::npos) << a.disagreements.front();
  const auto agree = analyze_observability(load_system("planar"), {.anchors = 2});
  EXPECT_TRUE(agree.disagreements.empty()) << agree.disagreements.front();
}

TEST(Observability, MinimumSigmasMatchTheInformation) {
  const auto a = analyze_observability(load_system("monobot"), {.anchors = 1, .segments = 1, .lie = false});
  // One landmark and one anchor, measured 9 times with sigma 0.1 m: sigma of x is 0.1/3 m, of the landmark
  // sqrt(2) times that
  ASSERT_TRUE(a.information[0].sigma && a.information[1].sigma);
  EXPECT_NEAR(*a.information[0].sigma, 0.1 / 3, 1e-9);
  EXPECT_NEAR(*a.information[1].sigma, std::sqrt(2) * 0.1 / 3, 1e-9);
  const auto none = analyze_observability(load_system("monobot"), {.lie = false});
  EXPECT_FALSE(none.information[0].sigma);
}

TEST(Observability, IsDeterministicForASeed) {
  const auto once = analyze_observability(load_system("inertial"), {.lie = false}),
             again = analyze_observability(load_system("inertial"), {.lie = false});
  EXPECT_EQ(once.local.space.singular_values, again.local.space.singular_values);
  EXPECT_EQ(once.points[2].x, again.points[2].x);
}

TEST(Observability, ReportsTheOrderLimitOfLieDerivatives) {
  ObservabilitySettings settings;
  settings.lie_settings.max_order = 1;
  const auto a = analyze_observability(load_system("cv6"), settings);
  EXPECT_FALSE(a.lie->closed);
  EXPECT_EQ(a.lie->orders_examined, 1);
  ASSERT_FALSE(a.doubts.empty());
  EXPECT_NE(a.doubts.front().find("up to order 1"), std::string::npos) << a.doubts.front();
}

TEST(Observability, RefusesOptionsThatTheSystemLacks) {
  EXPECT_THROW(analyze_observability(load_system("planar", "relative"), {.anchors = 1}),
               std::invalid_argument);
  EXPECT_THROW(analyze_observability(load_system("planar"), {.motion = "sideways"}), std::invalid_argument);
  EXPECT_THROW(analyze_observability(load_system("planar"), {.landmarks = 0}), std::invalid_argument);
  EXPECT_THROW(analyze_observability(load_system("planar"), {.segments = 0}), std::invalid_argument);
}

/// A vehicle that measures its own state, without landmarks.
SystemText alone(const std::string& states, const std::string& region, const std::string& measurements,
                 const std::string& inputs = "") {
  return read_system("name = \"alone\"\n[states]\n" + states + "[region]\n" + region + "[inputs]\n" + inputs +
                         "[measurements]\n" + measurements,
                     "alone.toml");
}

ObservabilityAnalysis analyzed(const SystemText& text, int segments = 3) {
  return analyze_observability(text, {.landmarks = 0, .segments = segments});
}

TEST(Observability, CountsInputsInMeasurements) {
  const auto a =
      analyzed(alone("a = 0\nb = 0\n", "a = [1, 2]\nb = [1, 2]\n", "z = \"u*a + b\"\n", "u = [-1, 1]\n"));
  EXPECT_EQ(a.lie->space.nullity, 0);
  EXPECT_EQ(a.local.space.nullity, 0);
}

TEST(Observability, UsesAsManyNonlinearInputsAsNecessary) {
  const auto a = analyzed(
      alone("x = \"u*a + u^2*b + u^3*c + u^4*d\"\na = 0\nb = 0\nc = 0\nd = 0\n",
            "x = [1, 2]\na = [1, 2]\nb = [1, 2]\nc = [1, 2]\nd = [1, 2]\n", "z = \"x\"\n", "u = [0.5, 2]\n"),
      6);
  EXPECT_EQ(a.lie->space.nullity, 0);
  EXPECT_EQ(a.local.space.nullity, 0);
}

TEST(Observability, TreatsAFixedInputAsAConstant) {
  const auto a =
      analyzed(alone("x = \"v\"\nk = 0\n", "x = [1, 2]\nk = [1, 2]\n", "z = \"k*x\"\n", "v = [0, 0]\n"));
  EXPECT_EQ(a.lie->space.nullity, 1);
  EXPECT_EQ(a.local.space.nullity, 1);
}

TEST(Observability, SamplesAnOscillationAtSeveralPhases) {
  // 4 Hz, where eight equally spaced measurements a second would always sample p at 0
  const auto a =
      analyzed(alone("x = \"p\"\np = \"-(8*pi)^2*x\"\n", "x = [1, 2]\np = [1, 2]\n", "z = \"x\"\n"));
  EXPECT_EQ(a.local.space.nullity, 0);
}

TEST(Observability, AcceptsMeasurementsOfAnyScale) {
  for (const char* z : {"z = \"1e200*x\"\n", "z = \"1e-200*x\"\n"}) {
    const auto a = analyzed(alone("x = 1\n", "x = [1, 2]\n", z));
    EXPECT_EQ(a.segments[0].stripped.space.nullity, 0) << z;
    EXPECT_EQ(a.local.space.nullity, 0) << z;
  }
}

TEST(Observability, DoubtsADivergingMotion) {
  const auto a = analyzed(alone("x = \"9*x\"\nk = 0\n", "x = [1, 2]\nk = [1, 2]\n", "z = \"x\"\n"));
  ASSERT_FALSE(a.doubts.empty());
  EXPECT_NE(a.doubts.front().find("grow by a factor"), std::string::npos) << a.doubts.front();
  EXPECT_FALSE(a.sigmas_trusted);
}

TEST(Observability, DoubtsANearlyDeficientRank) {
  const auto a = analyzed(
      alone("a = 0\nb = 0\n", "a = [1, 2]\nb = [1, 2]\n", "z1 = \"a + b\"\nz2 = \"a + (1 + 4e-10)*b\"\n"));
  EXPECT_FALSE(a.doubts.empty());
}

/// Many definitions, each containing the previous one twice, with the input in the first: expanded, they
/// would have 2^60 terms.
TEST(Observability, DoesNotExpandDefinitions) {
  std::string text =
      "name = \"deep\"\n[inputs]\nu = [1, 2]\n[states]\nx = \"d60\"\n[region]\nx = [1, 2]\n"
      "[measurements]\nz = \"x\"\n[definitions]\nd0 = \"x + u\"\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "d" + std::to_string(i - 1);
    text += "d" + std::to_string(i) + " = \"(sin(" + before + ") + " + before + ")/4\"\n";
  }
  try {
    EXPECT_EQ(analyzed(read_system(text, "deep.toml")).lie->space.nullity, 0);
  } catch (const SystemTooLarge&) {
    SUCCEED() << "refused in time";
  }
}

/// A vehicle on a line with the single measurement `text`.
SystemText measuring(const std::string& text) {
  return read_system(
      "name = \"line\"\n[states]\nx = 1\n[region]\nx = [1, 2]\n[measurements]\nz = \"" + text + "\"\n",
      "line.toml");
}

SourceLocation refused(const std::string& text, const std::string& because) {
  try {
    analyze_observability(measuring(text), {.landmarks = 0});
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find(because), std::string::npos) << error.what();
    return error.location;
  }
  ADD_FAILURE() << text << " was not refused";
  return {};
}

SystemText chain_of(const std::string& factor) {
  const std::string f = factor + "*";
  return read_system("name = \"chain\"\n[states]\nx = \"" + f + "v\"\nv = \"" + f + "w\"\nw = \"" + f +
                         "q\"\nq = 0\n[region]\nx = [-1, 1]\nv = [-1, 1]\nw = [-1, 1]\nq = [-1, 1]\n"
                         "[measurements]\nz = \"x\"\n",
                     "chain.toml");
}

TEST(Observability, RanksAreIndependentOfUnits) {
  const std::vector<std::pair<std::string, std::string>> units{
      {"1e-11", "[1e11, 2e11]"}, {"1e-9", "[1e9, 2e9]"},     {"1", "[1, 2]"},
      {"1e9", "[1e-9, 2e-9]"},   {"1e11", "[1e-11, 2e-11]"}, {"1e9", "[1, 2]"}};
  for (const auto& [k, region] : units) {
    const std::string text = std::string("name = \"sum\"\n[states]\nx = 0\ny = 0\nw = 0\n[region]\n") +
                             "x = [-1, 1]\ny = " + region + "\nw = [-1, 1]\n[measurements]\nz = \"x + " + k +
                             "*y\"\n";
    const ObservabilityAnalysis a = analyze_observability(read_system(text, "sum.toml"), {.landmarks = 0});
    for (const NullSpace* space :
         {&a.segments.back().stripped.space, &a.segments.back().total.space, &a.local.space, &a.lie->space}) {
      EXPECT_EQ(space->nullity, 2) << text;
      EXPECT_FALSE(space->ambiguous) << text;
    }
    ASSERT_EQ(a.local.directions.size(), 2u);
    for (const auto& d : a.local.directions) EXPECT_TRUE(a.local.space.contains(d.vector)) << text << d.name;
  }
}

TEST(Observability, ReportsEffectsBelowRounding) {
  const ObservabilityAnalysis clear = analyze_observability(chain_of("0.01"), {.landmarks = 0});
  EXPECT_EQ(clear.lie->space.nullity, 0);
  EXPECT_EQ(clear.local.space.nullity, 0);
  EXPECT_TRUE(clear.disagreements.empty());
  // The last state changes the measurement by 1e-18 of the first
  const ObservabilityAnalysis faint = analyze_observability(chain_of("1e-6"), {.landmarks = 0});
  EXPECT_TRUE(faint.local.space.nullity == 0 || faint.local.space.ambiguous);
  EXPECT_TRUE(faint.lie->space.nullity == 0 || !faint.lie->closed);
  for (const std::string& said : faint.disagreements)
    EXPECT_EQ(said.find("keeps H constant"), std::string::npos) << said;
}

/// Two ranges to points on the axis along which a vehicle drives: its lateral offset is nearly unobservable.
ObservabilityAnalysis beside_the_axis(const std::string& y) {
  const std::string text =
      "name = \"mirror\"\n[inputs]\nv = [1, 2]\n[states]\nx = \"v\"\ny = 0\n[region]\nx = [-5, 5]\n"
      "y = [1, 5]\n[anchor.constants]\na = [-5, 5]\n[anchor.measurements]\nr = \"sqrt((a-x)^2 + y^2)\"\n"
      "[motion.near]\ny = " +
      y + "\n";
  return analyze_observability(read_system(text, "m.toml"), {.landmarks = 0, .anchors = 2, .motion = "near"});
}

TEST(Observability, ReportsWeakObservability) {
  const ObservabilityAnalysis near = beside_the_axis("1e-6");
  EXPECT_EQ(near.local.space.nullity, 0);
  EXPECT_TRUE(near.information[1].weakly_observable && !near.information[0].weakly_observable);
  EXPECT_TRUE(says(near, "y is only weakly observable: sigma 1.3e+06, width of its region 4."))
      << remarks(near);
  const ObservabilityAnalysis far = beside_the_axis("2");
  EXPECT_FALSE(far.information[1].weakly_observable);
  EXPECT_FALSE(says(far, "weakly observable")) << remarks(far);
}

TEST(Observability, NamesStatesWithAnEffectBelowRounding) {
  const ObservabilityAnalysis a = analyze_observability(
      read_system("name = \"faint\"\n[states]\nx = 0\ny = 0\n[region]\nx = [-5e8, 5e8]\ny = [-5, 5]\n"
                  "[measurements]\nz = \"sqrt(x^2 + y^2)\"\n",
                  "faint.toml"),
      {.landmarks = 0});
  ASSERT_TRUE(a.local.space.ambiguous);
  EXPECT_EQ(a.local.space.faint, (std::vector<bool>{false, true}));
  EXPECT_FALSE(a.sigmas_trusted);
  EXPECT_TRUE(says(a, "the effect of y on the measurements is below rounding")) << remarks(a);
  EXPECT_FALSE(says(a, "times the next")) << remarks(a);
}

TEST(Observability, ReportsWhyTheInformationHasALargerNullSpace) {
  const auto a =
      analyzed(alone("x = 0\nb = 0\n", "x = [0, 1]\nb = [0, 1]\n", "m = \"1e-12*x\"\nn = \"x + b\"\n"));
  EXPECT_EQ(a.local.space.nullity, 0);
  EXPECT_EQ(a.fisher.space.nullity, 1);
  EXPECT_TRUE(says(a, "weights each measurement with its sensitivity over its sigma")) << remarks(a);
}

TEST(Observability, NamesUnusedInputs) {
  const auto a =
      analyzed(alone("x = \"v\"\n", "x = [1, 2]\n", "z = \"x\"\n", "v = [0, 1]\nspare = [0, 1]\n"));
  EXPECT_TRUE(says(a, "Input `spare` occurs in no equation and no measurement")) << remarks(a);
  EXPECT_FALSE(says(a, "`v`")) << remarks(a);
}

TEST(Observability, LocatesAnUndefinedExpression) {
  EXPECT_EQ(refused("1/(x - x)", "a division by zero").line, 7);
  EXPECT_EQ(refused("1/(x*0.5 + x/2 - 2*x/2 + sin(x - x))", "").column, 6);
  EXPECT_EQ(refused("log(sin(x) - 2)", "operating point").column, 6);
  EXPECT_EQ(refused("sqrt(-x)", "not finite").line, 7);
  EXPECT_EQ(refused("log(0)", "has no value").line, 7);
  EXPECT_EQ(refused("sqrt(-2)*x", "not finite").line, 7);
}

TEST(Observability, RefusesExpressionsThatAreTooLarge) {
  std::string product = "x + 1";
  for (int i = 2; i < 200; ++i) product += ")*(x + " + std::to_string(i);
  EXPECT_EQ(refused("(" + product + ")", "factors").line, 7);
  EXPECT_EQ(refused("9^9^9^9", "").line, 7);
  EXPECT_EQ(refused("x*(10^300)^(10^300)", "").line, 7);
}

}  // namespace
}  // namespace incognita
