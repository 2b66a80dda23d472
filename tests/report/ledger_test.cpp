#include "incognita/report/ledger.hpp"

#include <gtest/gtest.h>

#include <limits>
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
  const Claim holds{.id = "3.1-one",
                    .place = "(3.8)",
                    .statement = "an eigenvalue is 1",
                    .printed = "1",
                    .measured = "1 +- 1e-15",
                    .finding = Finding::holds,
                    .source = ClaimSource{"3.1", "42-51", "on the unit circle"}};
  const Claim misprint{.id = "3.1-two",
                       .place = "(3.11)",
                       .statement = "steady | state",
                       .printed = "s_v^2\n* 2",
                       .measured = "0.25 < 1",
                       .finding = Finding::misprint,
                       .why = "after one step",
                       .runs = 200,
                       .rule = Rule::equality,
                       .number = ClaimNumber{"variance", {0.25, 0.2, 0.3}, "m^2"},
                       .source = ClaimSource{"Abstract", "ii", "a *steady* state"},
                       .by_method = Finding::does_not_hold,
                       .headline = "It is steady."};
  const Claim undecided{.id = "3.1-three",
                        .place = "(3.12)",
                        .statement = "it grows",
                        .printed = "",
                        .measured = "0.1 (-1 to 1)",
                        .finding = Finding::undecided,
                        .why = "too few",
                        .runs = 3,
                        .least_runs = 20,
                        .timed = true,
                        .rule = Rule::boundedness,
                        .number = ClaimNumber{"growth", {0.1, -std::numeric_limits<double>::infinity(), 1}}};
  return {{"3.1",
           "Monobot",
           "",
           {holds, misprint, undecided},
           {{"fig-3.4", "figures/fig-3.4.svg", "figures/fig-3.4.csv"}}},
          {"3.2", "Car park", "the recording is not there: docs/data.md", {}, {}}};
}

TEST(Ledger, ConformsToItsSchema) {
  EXPECT_EQ(schema_faults(ledger_json(example())), "");
  EXPECT_EQ(schema_faults(ledger_json({})), "");
  EXPECT_EQ(ledger_json({}), "[]\n");
  EXPECT_NE(schema_faults(R"([{"id": "3.1", "title": "", "claims": [{}], "figures": []}])"), "");
}

TEST(Ledger, HasEveryField) {
  const Json json = Json::parse(ledger_json(example()));
  ASSERT_EQ(json.size(), 2u);
  const Json& claim = json[0]["claims"][1];
  EXPECT_EQ(claim["printed"], "s_v^2\n* 2");
  EXPECT_EQ(claim["origin"], "thesis");
  EXPECT_EQ(claim["quotation"], "a *steady* state");
  EXPECT_EQ(claim["rule"], "equality");
  EXPECT_EQ(claim["finding"], "misprint");
  EXPECT_EQ(claim["by_method"], "does-not-hold");
  EXPECT_EQ(claim["verdict"], "holds-as-corrected");
  EXPECT_EQ(claim["number"]["high"], 0.3);
  EXPECT_EQ(claim["runs"], 200);
  const Json& last = json[0]["claims"][2];
  EXPECT_EQ(last["origin"], "own");
  EXPECT_FALSE(last.contains("quotation"));
  EXPECT_EQ(last["verdict"], "undecided");
  EXPECT_EQ(last["least_runs"], 20);
  EXPECT_FALSE(last["number"].contains("low"));
  EXPECT_EQ(json[0]["figures"][0]["data"], "figures/fig-3.4.csv");
  EXPECT_FALSE(json[0].contains("skipped"));
  EXPECT_EQ(json[1]["skipped"], "the recording is not there: docs/data.md");
}

TEST(Ledger, ReadsWhatItWrites) {
  const std::string document = ledger_json(example());
  EXPECT_EQ(ledger_json(read_ledger(document, "claims.json")), document);
}

TEST(Ledger, RefusesWhatItDoesNotWrite) {
  const std::string document = ledger_json(example());
  EXPECT_HAS(testing::message_of([&] { read_ledger(document.substr(0, 300), "old.json"); }),
             "old.json: is not what `incognita reproduce` writes");
  std::string other = document;
  other.replace(other.find("\"misprint\""), 10, "\"perhaps\"");
  EXPECT_HAS(testing::message_of([&] { read_ledger(other, "old.json"); }), "unknown word `perhaps`");
  EXPECT_HAS(testing::message_of([&] { read_ledger("{}", "old.json"); }), "old.json");
}

TEST(Ledger, AcceptsTextThatIsNotUtf8) {
  std::vector<LedgerEntry> entries = example();
  entries[1].skipped = "\xff is not there";
  EXPECT_EQ(schema_faults(ledger_json(entries)), "");
}

TEST(Ledger, FindingsHaveTheirNamesAndVerdicts) {
  EXPECT_STREQ(name(Finding::holds), "holds");
  EXPECT_STREQ(name(Finding::holds_if), "holds-if");
  EXPECT_STREQ(name(Finding::does_not_hold), "does-not-hold");
  EXPECT_STREQ(verdict(Finding::holds), "holds");
  EXPECT_STREQ(verdict(Finding::misprint), "holds-as-corrected");
  EXPECT_STREQ(verdict(Finding::holds_if), "holds-as-corrected");
  EXPECT_STREQ(verdict(Finding::does_not_hold), "does-not-hold");
  EXPECT_STREQ(verdict(Finding::undecided), "undecided");
}

TEST(LedgerPage, CountsTheThesisApart) {
  const std::string page = ledger_markdown(example());
  EXPECT_HAS(page, "# Claims\n");
  EXPECT_HAS(page,
             "| | holds | misprint | holds if | does not hold | undecided | all |\n"
             "|---|---:|---:|---:|---:|---:|---:|\n"
             "| Abstract | 0 | 1 | 0 | 0 | 0 | 1 |\n"
             "| Chapter 3 | 1 | 0 | 0 | 0 | 0 | 1 |\n"
             "| the thesis | 1 | 1 | 0 | 0 | 0 | 2 |\n"
             "| ours | 0 | 0 | 0 | 0 | 1 | 1 |\n");
  EXPECT_HAS(page, "Entries skipped: 1.");
}

TEST(LedgerPage, CountsAppendicesAfterTheChapters) {
  Claim claim = example()[0].claims[0];
  std::vector<LedgerEntry> entries(1);
  for (const char* section : {"C.4", "7.2", "A.2.7"}) {
    claim.source = ClaimSource{section, "1", "words"};
    entries[0].claims.push_back(claim);
  }
  const std::string page = ledger_markdown(entries);
  EXPECT_LT(page.find("| Chapter 7 |"), page.find("| Appendix A |"));
  EXPECT_LT(page.find("| Appendix A |"), page.find("| Appendix C |"));
}

TEST(LedgerPage, BeginsWithHeadlinesAndErrata) {
  const std::string page = ledger_markdown(example());
  EXPECT_HAS(page, "1. It is steady. ([3.1-two](#31-two))\n");
  EXPECT_HAS(page, "| (3.11) | s_v^2 \\* 2 | after one step | [3.1-two](#31-two) |\n");
  for (const Rule rule : all_rules())
    EXPECT_HAS(page, std::string("| ") + name(rule) + " | " + rule_text(rule));
}

TEST(LedgerPage, HasABlockForEachClaim) {
  const std::string page = ledger_markdown(example());
  EXPECT_HAS(page, "\n## 3.1: Monobot\n\nRun again: `incognita reproduce 3.1`. Figures: fig-3.4.\n");
  EXPECT_HAS(page,
             "\n### 3.1-two\n\n"
             "> a \\*steady\\* state ((3.11); Abstract, p. ii)\n\n"
             "steady \\| state\n\n"
             "- Finding: **misprint**; by the method of the thesis: does not hold\n"
             "- Number: variance: 0.25 m^2 (0.2 to 0.3)\n"
             "- Printed: s_v^2 \\* 2\n- Measured: 0.25 \\< 1\n- Right form: after one step\n"
             "- Rule: equality; 200 runs\n");
  EXPECT_HAS(page, "Ours, beside (3.12).\n\nit grows\n");
  EXPECT_HAS(page, "\n## 3.2: Car park\n\nSkipped: the recording is not there: docs/data.md\n");
}

}  // namespace
}  // namespace incognita
