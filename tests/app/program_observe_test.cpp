// `incognita observe` as a person or a script meets it.
#include <gtest/gtest.h>

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
  EXPECT_EQ(testing::faults(document, json::parse(schema)), "");
  return document;
}

TEST(ProgramObserve, AnswersAsItsSchemaSays) {
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

TEST(ProgramObserve, SaysTheSameForTheSameSeed) {
  for (const char* as : {"--json", "--latex"}) {
    const Ended once = observe({"inertial", "--seed", "7", as});
    EXPECT_EQ(once.code, 0);
    EXPECT_EQ(observe({"inertial", "--seed", "7", as}).out, once.out);
  }
  EXPECT_NE(observe({"inertial", "--seed", "8", "--json"}).out,
            observe({"inertial", "--seed", "7", "--json"}).out);
}

TEST(ProgramObserve, ShowsATableAndMatrices) {
  const Ended table = observe({"planar", "--anchors", "1"});
  EXPECT_EQ(table.code, 0);
  EXPECT_EQ(table.err, "");
  for (const char* part : {"SOM, segments 1 to 2", "Lie derivatives", "rotation +", "The methods disagree"})
    EXPECT_SAYS(table.out, part);
  const Ended latex = observe({"planar", "--latex"});
  // thesis (4.15), its first entry
  EXPECT_SAYS(latex.out, "\\frac{r_{y}}{r_{x}^{2} + r_{y}^{2}} & -\\frac{r_{x}}{r_{x}^{2} + r_{y}^{2}} & -1");
  EXPECT_SAYS(latex.out, "-v \\sin\\left(\\theta\\right)");
}

TEST(ProgramObserve, TakesASystemThatSomebodyWrote) {
  const json drone = answer({INCOGNITA_SOURCE_DIR "/docs/systems/drone.toml", "--features", "3"});
  EXPECT_EQ(drone["local_nullity"], 3);
  EXPECT_EQ(drone["segments"][2]["nullspace"][0], (json{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}));
}

std::string line(const std::string& rate, const std::string& more = "") {
  return "name = \"line\"\n[states]\nx = \"" + rate +
         "\"\n[region]\nx = [1, 2]\n[measurements]\nz = \"x\"\n" + more;
}

TEST(ProgramObserve, RefusesBadSystemsWithTheirPlace) {
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

TEST(ProgramObserve, RefusesWhatMakesNoSense) {
  const std::pair<Words, std::string> wrong[] = {
      {{"plannar"}, "planar"},
      {{"nowhere.toml"}, "nowhere.toml"},
      {{"planar", "--motion", "sideways"}, "general, straight, stationary, unaccelerated"},
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
