// The command `incognita observe` for a user and for a script.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/app/program.hpp"
#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using nlohmann::json;
using testing::Ended;
using testing::Scratch;
using testing::Words;

Ended observe(const Words& more, const Scratch& scratch = Scratch()) {
  Words words = {"observe"};
  words.insert(words.end(), more.begin(), more.end());
  return testing::incognita(words, scratch.folder());
}

json answer(Words words) {
  words.push_back("--json");
  const Ended ended = observe(words);
  EXPECT_EQ(ended.code, 0) << ended.err;
  const json document = json::parse(ended.out, nullptr, false);
  std::ifstream schema(INCOGNITA_SOURCE_DIR "/docs/schemas/observe.schema.json");
  EXPECT_EQ(testing::problems(document, json::parse(schema)), "");
  return document;
}

TEST(ProgramObserve, AnswerConformsToItsSchema) {
  const json planar = answer({"planar"});
  EXPECT_EQ(planar["system"], "planar");
  EXPECT_EQ(planar["states"], (json{"x", "y", "theta", "xf_1", "yf_1"}));
  ASSERT_EQ(planar["segments"].size(), 3u);
  EXPECT_EQ(planar["segments"][0]["som_nullity"], 3);
  EXPECT_EQ(planar["segments"][1]["som_nullity"], 2);
  EXPECT_EQ(planar["segments"][1]["nullspace"], (json{{1, 0, 0, 1, 0}, {0, 1, 0, 0, 1}})) << "thesis (4.20)";
  EXPECT_EQ(planar["local_nullity"], 3);
  EXPECT_EQ(planar["lie_nullity"], 3);
  EXPECT_EQ(planar["directions"][2]["name"], "rotation");
  EXPECT_EQ(planar["disagreements"].size(), 1u);
  const json without = answer({"cv6", "--anchors", "3", "--features", "3", "--no-lie"});
  EXPECT_TRUE(without["lie_nullity"].is_null());
  EXPECT_EQ(without["local_nullity"], 0);
  const json relative = answer({"planar", "--representation", "relative", "--motion", "stationary"});
  EXPECT_EQ(relative["representation"], "relative");
  EXPECT_EQ(relative["segments"][2]["som_nullity"], 2);
}

/// All drawn values, so that the ranks can be checked.
TEST(ProgramObserve, ReportsTheOperatingPoint) {
  const json a = answer({"planar", "--anchors", "2", "--no-lie"});
  const json &first = a["segments"][0], &second = a["segments"][1];
  ASSERT_EQ(first["start"].size(), 5u);
  for (const auto& state : a["states"]) EXPECT_TRUE(first["start"].contains(state)) << state;
  EXPECT_EQ(first["duration_s"], 1.0);
  // The state after the segment, by the vehicle's equations
  const double v = first["inputs"]["v"], omega = first["inputs"]["omega"], theta = first["start"]["theta"];
  EXPECT_NEAR(second["start"]["theta"].get<double>(), theta + omega, 1e-9);
  EXPECT_NEAR(second["start"]["x"].get<double>(),
              first["start"]["x"].get<double>() + v / omega * (std::sin(theta + omega) - std::sin(theta)),
              1e-9);
  ASSERT_EQ(a["anchors_at"].size(), 2u);
  EXPECT_LE(a["anchors_at"][1]["ax"].get<double>(), -3);
  EXPECT_EQ(a["measurements_per_segment"], 8);
  ASSERT_EQ(a["measurement_times_s"].size(), 25u);
  EXPECT_EQ(a["measurement_times_s"][0], 0.0);
  EXPECT_NEAR(a["measurement_times_s"][8].get<double>(), 1, 1e-12);
  EXPECT_NEAR(a["measurement_times_s"][24].get<double>(), 3, 1e-12);
  const Ended table = observe({"planar"});
  EXPECT_SAYS(table.out, "Segment 1 is at x = ");
  EXPECT_SAYS(table.out, "25 measurement times in total");
  EXPECT_SAYS(observe({"cv6", "--features", "2", "--no-lie"}).out, "the starts and inputs of the segments, ");
}

TEST(ProgramObserve, IsDeterministicForASeed) {
  for (const char* as : {"--json", "--latex"}) {
    const Ended once = observe({"inertial", "--seed", "7", as});
    EXPECT_EQ(once.code, 0);
    EXPECT_EQ(observe({"inertial", "--seed", "7", as}).out, once.out);
  }
  EXPECT_NE(observe({"inertial", "--seed", "8", "--json"}).out,
            observe({"inertial", "--seed", "7", "--json"}).out);
}

TEST(ProgramObserve, PrintsATableAndMatrices) {
  const Ended table = observe({"planar", "--anchors", "1"});
  EXPECT_EQ(table.code, 0);
  EXPECT_EQ(table.err, "");
  for (const char* part : {"SOM, segments 1 to 2", "Lie derivatives", "rotation +", "The methods disagree"})
    EXPECT_SAYS(table.out, part);
  const Ended latex = observe({"planar", "--latex"});
  // first entry of thesis (4.15)
  EXPECT_SAYS(latex.out, "\\frac{r_{y}}{r_{x}^{2} + r_{y}^{2}} & -\\frac{r_{x}}{r_{x}^{2} + r_{y}^{2}} & -1");
  EXPECT_SAYS(latex.out, "-v \\sin\\left(\\theta\\right)");
}

TEST(ProgramObserve, TypesetsTheMatricesThatItUses) {
  const Scratch scratch;
  scratch.write("s.toml",
                "name = \"s\"\n[parameters]\nL = 2\n[inputs]\nv = [1, 2]\n[states]\nx = \"v*cos(hitch)\"\n"
                "hitch = \"-v*sin(hitch)/L + lag - hitch^2\"\n[definitions]\nlag = \"-abs(hitch)\"\n"
                "[region]\nx = [0, 1]\nhitch = [0.1, 1]\n[measurements]\nz = \"sin(x + hitch)*L\"\n");
  const Ended latex = observe({"s.toml", "--latex"}, scratch);
  EXPECT_EQ(latex.code, 0) << latex.err;
  EXPECT_SAYS(latex.out, "% s: s\n");
  EXPECT_SAYS(latex.out, "\\[ \\mathit{lag} = -\\left|\\mathit{hitch}\\right| \\]");
  EXPECT_SAYS(latex.out, "% vehicle: L_0 z\n\\[ \\mathcal{L}_{0} z = ");
  EXPECT_SAYS(latex.out, "\\[ \\mathcal{L}_{0} \\mathit{hitch} = \\mathit{lag} - \\mathit{hitch}^{2} \\]");
  EXPECT_EQ(latex.out.find("L_{0 "), std::string::npos) << latex.out;
}

TEST(ProgramObserve, AcceptsASystemFileOfAUser) {
  const json drone = answer({INCOGNITA_SOURCE_DIR "/docs/systems/drone.toml", "--features", "3"});
  EXPECT_EQ(drone["local_nullity"], 3);
  EXPECT_EQ(drone["segments"][2]["nullspace"][0], (json{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}));
}

/// The table for a system with this text.
std::string table_of(const std::string& text, const Words& more = {}) {
  const Scratch scratch;
  scratch.write("s.toml", text);
  Words words = {"s.toml"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended ended = observe(words, scratch);
  EXPECT_EQ(ended.code, 0) << ended.err;
  return ended.out;
}

TEST(ProgramObserve, TableIsConsistentWithItsRemarks) {
  const std::string faint = table_of(
      "name = \"s\"\n[states]\nx = 0\nb = 0\n[region]\nx = [0, 1]\nb = [0, 1]\n"
      "[measurements]\nm = \"1e-12*x\"\nn = \"x + b\"\n");
  EXPECT_SAYS(faint, "Unobservable by the Fisher information:\n  ");
  const std::string stiff =
      table_of("name = \"s\"\n[states]\nx = \"9*x\"\n[region]\nx = [1, 2]\n[measurements]\nz = \"x\"\n");
  EXPECT_SAYS(stiff, "for this motion (unreliable: see the notes): x");
  for (const std::string& table : {faint, stiff}) EXPECT_EQ(table.find("; \n"), std::string::npos) << table;
}

std::string line(const std::string& rate, const std::string& more = "") {
  return "name = \"line\"\n[states]\nx = \"" + rate +
         "\"\n[region]\nx = [1, 2]\n[measurements]\nz = \"x\"\n" + more;
}

TEST(ProgramObserve, RefusesInvalidSystemsWithTheirLocation) {
  std::string long_sum = "x";
  for (int i = 0; i < 40; ++i) long_sum = "sin(" + long_sum + "*x)";
  const std::pair<std::string, std::string> wrong[] = {
      {line("speed"), "bad.toml:3:6: "},
      {line("(x + 1"), "bad.toml:3:6: "},
      {line("x + * 2"), "bad.toml:3:10: "},
      {line("1/(x - x)"), "bad.toml:3:6: "},
      {line("log(-x)"), "bad.toml:3:6: "},
      {line("9^9^9^9"), "bad.toml:3:6: "},
      {line(long_sum), "bad.toml:3:6: "},
      {line("x^2*1000"), "bad.toml:3:6: "},
      {"name = \"line\"\n[states]\n[region]\nx = [1, 2]\n[measurements]\nz = \"x\"\n", "bad.toml:4:1: "},
      {"name = \"line\"\n[states]\nx = 1\n", "bad.toml:3:1: "},
      {"nothing", "bad.toml:1:"},
      {"", "bad.toml: "}};
  for (const auto& [text, place] : wrong) {
    const Scratch scratch;
    scratch.write("bad.toml", text);
    const Ended ended = observe({"bad.toml", "--features", "0"}, scratch);
    EXPECT_EQ(ended.code, 2) << text;
    EXPECT_SAYS(ended.err, place);
    EXPECT_EQ(ended.out, "");
  }
}

TEST(ProgramObserve, LocatesADivisionByZero) {
  const std::string zero = line("x/k", "[parameters]\nk = 0\n"),
                    held = line("1/v", "[inputs]\nv = [1, 2]\n[motion.parked]\nv = 0\n");
  for (const auto& [text, name] : {std::pair{zero, "`k`"}, std::pair{held, "`v`"}}) {
    const Scratch scratch;
    scratch.write("bad.toml", text);
    const std::string motion = text == held ? "parked" : "general";
    const Ended ended = observe({"bad.toml", "--motion", motion}, scratch);
    EXPECT_EQ(ended.code, 2) << text;
    EXPECT_SAYS(ended.err, "bad.toml:3:6: ");
    EXPECT_SAYS(ended.err, std::string("with ") + name + " at 0");
    EXPECT_SAYS(ended.err, std::string("another value, range or motion for ") + name);
  }
}

TEST(ProgramObserve, RepeatsNothingOfTheAnswer) {
  EXPECT_EQ(observe({"planar", "--json"}).err, "") << "the answer contains the disagreements";
  EXPECT_SAYS(observe({"planar", "--latex"}).err, "SOM over 3 segments has nullity 2");
}

TEST(ProgramObserve, RefusesInapplicableOptions) {
  const std::pair<Words, std::string> wrong[] = {
      {{"plannar"}, "planar"},
      {{"nowhere.toml"}, "nowhere.toml"},
      {{"planar", "--motion", "sideways"}, "general, straight, stationary, unaccelerated"},
      {{"planar", "--motion", "sideways"}, "planar: `planar` has no motion"},
      {{"planar", "--representation", "relative", "--anchors", "1"}, "no anchors"},
      {{"cv6", "--representation", "relative"}, "cv6"},
      {{"planar", "--features", "0"}, "nothing is measured"},
      {{"planar", "--features", "-1"}, "--features"},
      {{"planar", "--segments", "0"}, "--segments"},
      {{"planar", "--json", "--latex"}, "not both"}};
  for (const auto& [words, message] : wrong) {
    const Ended ended = observe(words);
    EXPECT_EQ(ended.code, 2) << words[0];
    EXPECT_SAYS(ended.err, message);
    EXPECT_EQ(ended.out, "");
  }
}

}  // namespace
}  // namespace incognita
