#include "incognita/report/ledger.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Json;

std::string schema_faults(const std::string& document) {
  const std::string schema =
      testing::contents(std::string(INCOGNITA_SOURCE_DIR) + "/docs/schemas/reproduce.schema.json");
  return testing::problems(Json::parse(document), Json::parse(schema));
}

std::vector<LedgerEntry> example() {
  const Claim holds{"3.1-one", "(3.8)", "an eigenvalue is 1", "1", "1 +- 1e-15", Verdict::holds, "", 1};
  const Claim corrected{"3.1-two",        "(3.11)",   "steady | state",
                        "s_v^2\n* 2",     "0.25 < 1", Verdict::holds_as_corrected,
                        "after one step", 200};
  const Claim undecided{"3.1-three",        "(3.12)",  "it grows", "", "0.1 (-1 to 1)",
                        Verdict::undecided, "too few", 3,          20};
  return {{"3.1",
           "Monobot",
           "",
           {holds, corrected, undecided},
           {{"fig-3.4", "figures/fig-3.4.svg", "figures/fig-3.4.csv"}}},
          {"3.2", "Car park", "the recording is not there: docs/data.md", {}, {}}};
}

TEST(Ledger, ConformsToItsSchema) {
  EXPECT_EQ(schema_faults(ledger_json(example())), "");
  EXPECT_EQ(schema_faults(ledger_json({})), "");
  EXPECT_EQ(ledger_json({}), "[]\n");
  EXPECT_NE(schema_faults(R"([{"id": "3.1", "title": "", "claims": [{}], "figures": []}])"), "");
}

TEST(Ledger, RoundTripsEveryField) {
  const Json json = Json::parse(ledger_json(example()));
  ASSERT_EQ(json.size(), 2u);
  const Json& claim = json[0]["claims"][1];
  EXPECT_EQ(claim["printed"], "s_v^2\n* 2");
  EXPECT_EQ(claim["verdict"], "holds-as-corrected");
  EXPECT_EQ(claim["runs"], 200);
  EXPECT_EQ(claim["least_runs"], 1);
  EXPECT_EQ(json[0]["claims"][2]["verdict"], "undecided");
  EXPECT_EQ(json[0]["claims"][2]["least_runs"], 20);
  EXPECT_EQ(json[0]["figures"][0]["data"], "figures/fig-3.4.csv");
  EXPECT_FALSE(json[0].contains("skipped"));
  EXPECT_EQ(json[1]["skipped"], "the recording is not there: docs/data.md");
  EXPECT_TRUE(json[1]["claims"].is_array());
}

TEST(Ledger, AcceptsTextThatIsNotUtf8) {
  std::vector<LedgerEntry> entries = example();
  entries[1].skipped = "\xff is not there";
  EXPECT_EQ(schema_faults(ledger_json(entries)), "");
}

TEST(Ledger, VerdictsHaveTheirNames) {
  EXPECT_STREQ(name(Verdict::holds), "holds");
  EXPECT_STREQ(name(Verdict::holds_as_corrected), "holds-as-corrected");
  EXPECT_STREQ(name(Verdict::does_not_hold), "does-not-hold");
  EXPECT_STREQ(name(Verdict::undecided), "undecided");
}

TEST(LedgerPage, CountsAndTabulates) {
  const std::string page = ledger_markdown(example());
  EXPECT_HAS(page, "# Claims\n");
  EXPECT_HAS(page, "incognita reproduce --out DIR");
  EXPECT_HAS(page,
             "| holds | 1 |\n| holds as corrected | 1 |\n| does not hold | 0 |\n| undecided | 1 |\n"
             "| (entries skipped) | 1 |\n");
  EXPECT_HAS(page, "\n## 3.1: Monobot\n\n| place | statement | printed | measured | verdict | why |\n");
  EXPECT_HAS(page, "| (3.8) | an eigenvalue is 1 | 1 | 1 +- 1e-15 | holds |  |\n");
  EXPECT_HAS(page, "\nFigures: `figures/fig-3.4.svg`\n");
  EXPECT_HAS(page, "\n## 3.2: Car park\n\nSkipped: the recording is not there: docs/data.md\n");
}

TEST(LedgerPage, EscapesWhatWouldBreakTheTable) {
  EXPECT_HAS(
      ledger_markdown(example()),
      "| (3.11) | steady \\| state | s_v^2 \\* 2 | 0.25 \\< 1 | holds as corrected | after one step |\n");
}

}  // namespace
}  // namespace incognita
