// The systems of Chapter 4 against ranks from an independent program, and the analysis against properties of
// any system.
#include "incognita/analysis/observability/observability.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>
#include <map>
#include <sstream>

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

class ThesisSystem : public testing::TestWithParam<const char*> {};

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
                         testing::Values("planar", "planar-rb", "planar-cv", "monobot", "inertial",
                                         "inertial-rb", "cv6"));

class BuiltIn : public testing::TestWithParam<std::string> {};

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

INSTANTIATE_TEST_SUITE_P(All, BuiltIn, testing::ValuesIn(built_in_systems()), [](const auto& one) {
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

class ErrorForm : public testing::TestWithParam<const char*> {};

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
                         testing::Values("inertial", "inertial-relative", "inertial-rb",
                                         "inertial-rb-relative", "cv6"));

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

/// All remarks of an analysis besides ranks.
std::string remarks(const ObservabilityAnalysis& a) {
  std::string all;
  for (const auto* lines : {&a.disagreements, &a.doubts, &a.notes})
    for (const std::string& line : *lines) all += line + "\n";
  return all;
}

bool says(const ObservabilityAnalysis& a, const std::string& part) {
  return remarks(a).find(part) != std::string::npos;
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

/// A robot with two wheels of unknown radius r and distance b, and a position sensor on the axle.
SystemText wheels(const std::string& motion) {
  return read_system(
      "name = \"wheels\"\n[states]\nx = \"r/2*(wl + wr)*cos(h)\"\ny = \"r/2*(wl + wr)*sin(h)\"\n"
      "h = \"r*(wr - wl)/b\"\nr = 0\nb = 0\n[region]\nx = [-1, 1]\ny = [-1, 1]\nh = [-3, 3]\n"
      "r = [0.05, 0.1]\nb = [0.3, 0.5]\n[inputs]\nwl = [1, 5]\nwr = [1, 5]\n[measurements]\n"
      "mx = \"x\"\nmy = \"y\"\n[motion.chosen]\n" +
          motion,
      "wheels.toml");
}

ObservabilityAnalysis in_motion(const SystemText& text) {
  return analyze_observability(text, {.landmarks = 0, .motion = "chosen"});
}

void expect_ranks(const ObservabilityAnalysis& a, int lie, int local) {
  EXPECT_EQ(a.lie->space.rank, lie) << remarks(a);
  EXPECT_EQ(a.local.space.rank, local) << remarks(a);
  EXPECT_EQ(a.fisher.space.rank, local) << remarks(a);
}

TEST(AssignedInput, EqualToAnotherVariesWithIt) {
  const auto a = in_motion(read_system(
      "name = \"equal\"\n[states]\nx = \"k*(u1 - u2)\"\nk = 0\n[region]\nx = [1, 2]\nk = [1, 2]\n"
      "[inputs]\nu1 = [1, 2]\nu2 = [1, 2]\n[measurements]\nz = \"x\"\n[motion.chosen]\nu1 = \"u2\"\n",
      "equal.toml"));
  expect_ranks(a, 1, 1);
  EXPECT_FALSE(says(a, "other inputs of this kind")) << remarks(a);
}

/// A motion has the same ranks whether it is written with an input or with a draw.
TEST(AssignedInput, MayBeWrittenWithADraw) {
  const std::string draw = "draw.q = [1, 5]\n";
  const auto straight = in_motion(wheels("wl = \"wr\"\n"));
  EXPECT_EQ(straight.lie->space.rank, in_motion(wheels(draw + "wl = \"q\"\nwr = \"q\"\n")).lie->space.rank);
  expect_ranks(straight, 4, 4);
  const auto spot = in_motion(wheels("wl = \"-wr\"\n"));
  EXPECT_EQ(spot.lie->space.rank, in_motion(wheels(draw + "wl = \"-q\"\nwr = \"q\"\n")).lie->space.rank);
  expect_ranks(spot, 2, 2);
  expect_ranks(in_motion(wheels("")), 5, 5);
}

/// The order in the file does not matter: u2 is assigned before u1, which is twice u2.
TEST(AssignedInput, MayBePartOfAChain) {
  const std::string head =
      "name = \"chain\"\n[states]\nx = \"k*(u1 - 2*u2) + c*(u2 + u3)\"\nk = 0\nc = 0\n[region]\n"
      "x = [1, 2]\nk = [1, 2]\nc = [1, 2]\n[inputs]\nu1 = [1, 2]\nu2 = [1, 2]\nu3 = [1, 2]\n"
      "[definitions]\ndouble = \"2*u2\"\n[measurements]\nz = \"x\"\n[motion.chosen]\n";
  for (const char* motion : {"u1 = \"2*u2\"\nu2 = \"-u3 + 1\"\n", "u2 = \"-u3 + 1\"\nu1 = \"2*u2\"\n",
                             "u1 = \"double\"\nu2 = \"-u3 + 1\"\n"}) {
    const auto a = in_motion(read_system(head + motion, "chain.toml"));
    expect_ranks(a, 2, 2);
    for (const SystemPoint& point : a.points) {
      EXPECT_DOUBLE_EQ(point.u[1], 1 - point.u[2]) << motion;
      EXPECT_DOUBLE_EQ(point.u[0], 2 * point.u[1]) << motion;
    }
  }
}

/// k moves x only with u1 - u2*p, which is 0 in one motion and not in the other.
TEST(AssignedInput, MayDependOnStatesAndDraws) {
  const std::string head =
      "name = \"mixed\"\n[states]\nx = \"k*(u1 - u2*p)\"\np = 0\nk = 0\n[region]\nx = [1, 2]\np = [1, 2]\n"
      "k = [1, 2]\n[inputs]\nu1 = [1, 2]\nu2 = [1, 2]\n[measurements]\nz = \"x\"\nzp = \"p\"\n"
      "[motion.chosen]\n";
  expect_ranks(in_motion(read_system(head + "u1 = \"u2*p\"\n", "m.toml")), 2, 2);
  expect_ranks(in_motion(read_system(head + "u1 = \"q*u2*p\"\ndraw.q = [2, 3]\n", "m.toml")), 3, 3);
}

/// A rate that is not affine in a draw takes as many values as there are monomials of the draw.
TEST(AssignedInput, MayHaveADrawToAnyPower) {
  const std::string head =
      "name = \"powers\"\n[states]\nx = \"a + b*u + c*w\"\na = 0\nb = 0\nc = 0\n[region]\nx = [1, 2]\n"
      "a = [1, 2]\nb = [1, 2]\nc = [1, 2]\n[inputs]\nu = [1, 2]\nw = [1, 2]\n[measurements]\nz = \"x\"\n"
      "[motion.chosen]\ndraw.q = [1, 2]\nu = \"q\"\n";
  expect_ranks(in_motion(read_system(head + "w = \"q^2\"\n", "p.toml")), 4, 4);
  expect_ranks(in_motion(read_system(head + "w = \"3*q\"\n", "p.toml")), 3, 3);
  expect_ranks(in_motion(read_system(head + "w = \"abs(q - 1.5)\"\n", "p.toml")), 4, 4);
}

TEST(AssignedInput, IsAssignedBeforeStatesThatDependOnIt) {
  const auto a = in_motion(read_system(
      "name = \"start\"\n[states]\nx = \"u\"\n[region]\nx = [1, 2]\n[inputs]\nu = [1, 2]\nw = [5, 6]\n"
      "[measurements]\nz = \"x\"\n[motion.chosen]\nx = \"u\"\nu = \"w\"\n",
      "start.toml"));
  EXPECT_GE(a.points[0].u[0], 5);
  EXPECT_EQ(a.points[0].x[0], a.points[0].u[0]);
}

TEST(AssignedInput, CyclicDependenceIsRefused) {
  const auto refusal = [](const std::string& motion) -> std::string {
    try {
      in_motion(wheels(motion));
    } catch (const SystemError& error) {
      EXPECT_GT(error.location.line, 0);
      return error.what();
    }
    return "accepted";
  };
  const std::string remedy = "; replace one of them by a drawn number (draw.q = [lowest, highest])";
  EXPECT_EQ(refusal("wl = \"2*wr\"\nwr = \"wl\"\n"),
            "the motion's assignments are circular: `wl` depends on `wr`, which depends on `wl`" + remedy);
  EXPECT_EQ(refusal("wl = \"wl + 1\"\n"),
            "the motion's assignments are circular: `wl` depends on `wl`" + remedy);
  EXPECT_EQ(refusal("x = \"wl\"\nwl = \"x\"\n"),
            "the motion's assignments are circular: `x` depends on `wl`, which depends on `x`" + remedy);
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
