// The command `incognita reproduce` with experiments defined for these tests.
#include "incognita/app/commands/reproduce.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "incognita/messages/errors.hpp"
#include "incognita/report/plot.hpp"
#include "tests/app/captured.hpp"
#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::Json;
using testing::Scratch;

LedgerEntry draws(const ExperimentSettings& settings) {
  if (settings.report) settings.report("half of it");
  Plot plot;
  plot.id = "fig-1.2";
  plot.panels.resize(1);
  plot.panels[0].curves = {over_steps("count", {1, 2, 3})};
  const Claim claim{"1.1-a",
                    "(1.1)",
                    "it counts",
                    "",
                    std::to_string(settings.seeds) + " runs",
                    Finding::does_not_hold,
                    "it was made up",
                    settings.seeds};
  return {"1.1", "Draws", "", {claim}, {draw_plot(settings.out, plot, nullptr)}};
}

LedgerEntry fails(const ExperimentSettings&) { throw std::runtime_error("it does not converge"); }

LedgerEntry skips(const ExperimentSettings&) {
  LedgerEntry entry;
  entry.id = "1.3";
  entry.title = "Skips";
  entry.skipped = "the recording is not there";
  return entry;
}

const std::vector<Experiment> experiments = {{"1.1", "Draws", {"fig-1.1", "fig-1.2"}, draws},
                                             {"1.2", "Fails", {"fig-1.3"}, fails},
                                             {"1.3", "Skips", {}, skips}};

using Result = testing::Captured;

Result reproduce(std::vector<std::string> words) {
  words.insert(words.begin(), "reproduce");
  return testing::captured(
      [](CLI::App& app, std::function<int()>& job) { add_reproduce(app, job, experiments); }, words);
}

TEST(Reproduce, RunsTheExampleOfAFigureWithItsWholeEntry) {
  const Scratch scratch;
  const Result result = reproduce({"fig-1.2", "1.1", "--json", "--seeds", "7", "--out", scratch / "out"});
  EXPECT_EQ(result.code, 0);
  const Json json = Json::parse(result.out);
  ASSERT_EQ(json.size(), 1u);  // named twice, run once
  EXPECT_EQ(json[0]["claims"][0]["verdict"], "does-not-hold");
  EXPECT_EQ(json[0]["claims"][0]["measured"], "7 runs");
  EXPECT_EQ(testing::problems(json, Json::parse(contents(std::string(INCOGNITA_SOURCE_DIR) +
                                                         "/docs/schemas/reproduce.schema.json"))),
            "");
  EXPECT_EQ(contents(scratch / "out/claims.json"), result.out);
  EXPECT_HAS(contents(scratch / "out/claims.md"), "### 1.1-a\n\nOurs, beside (1.1).\n\nit counts\n");
  EXPECT_TRUE(fs::exists(scratch / "out/figures/fig-1.2.csv"));
  EXPECT_HAS(result.err, "[1/1] 1.1: Draws");
  EXPECT_HAS(result.err, "half of it");
  EXPECT_HAS(result.err,
             "1 claim: 0 hold, 0 misprints, 0 hold on a condition, 1 does not hold, 0 are undecided");
}

TEST(Reproduce, ContinuesAfterAFailureAndReportsIt) {
  const Scratch scratch;
  const Result result = reproduce({"--out", scratch / "out"});
  EXPECT_EQ(result.code, 1);
  EXPECT_HAS(result.err, "1.2 failed: it does not converge");
  EXPECT_HAS(result.out, "1.1: Draws\n  does-not-hold       (1.1): it counts\n");
  EXPECT_HAS(result.out, "measured: 200 runs");
  EXPECT_HAS(result.out, "skipped: the recording is not there");
  const Json json = Json::parse(contents(scratch / "out/claims.json"));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1]["id"], "1.3");
}

TEST(Reproduce, ASkippedExperimentIsNotAFailure) {
  const Scratch scratch;
  const Result result = reproduce({"1.3", "--json", "--out", scratch / "out"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(Json::parse(result.out)[0]["skipped"], "the recording is not there");
  EXPECT_HAS(result.err, "skipped: the recording is not there");
  EXPECT_HAS(result.err, "skipped: 1.3; ");
  EXPECT_EQ(result.err.find("0 claims"), std::string::npos) << result.err;
}

TEST(Reproduce, ReplacesAnEarlierLedger) {
  const Scratch scratch;
  reproduce({"1.1", "--out", scratch / "out"});
  EXPECT_EQ(reproduce({"1.2", "--out", scratch / "out"}).code, 1);
  EXPECT_EQ(contents(scratch / "out/claims.json"), "[]\n");
}

TEST(Reproduce, UpdatesAnEarlierLedger) {
  const Scratch scratch;
  reproduce({"1.1", "1.3", "--out", scratch / "old"});
  reproduce({"1.1", "--seeds", "7", "--update", scratch / "old/claims.json", "--out", scratch / "new"});
  const Json json = Json::parse(contents(scratch / "new/claims.json"));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0]["claims"][0]["measured"], "7 runs");
  EXPECT_EQ(json[1]["id"], "1.3");
  const auto from = [&](const std::string& file) {
    return testing::message_of([&] { reproduce({"1.1", "--update", file, "--out", scratch / "x"}); });
  };
  EXPECT_HAS(from(scratch / "absent.json"), "absent.json");
  EXPECT_HAS(from(scratch / "old/claims.md"), "is not what `incognita reproduce` writes");
}

TEST(Reproduce, ListsWithoutRunning) {
  const Result text = reproduce({"--list"});
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(text.out, "1.1      Draws (fig-1.1, fig-1.2)\n1.2      Fails (fig-1.3)\n1.3      Skips\n");
  const Json json = Json::parse(reproduce({"--list", "--json", "fig-1.3"}).out);
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["id"], "1.2");
}

TEST(Reproduce, RefusesUnknownIds) {
  const auto message = [](const std::vector<std::string>& words) {
    return testing::message_of([&] { reproduce(words); });
  };
  EXPECT_HAS(message({"fig-1.22"}), "there is no example or figure `fig-1.22`; the nearest is `fig-1.2`");
  EXPECT_HAS(message({"1.1", "1.4"}), "no example or figure `1.4`; the nearest is `1.1`");
  EXPECT_HAS(message({"--out", ""}), "--out: is empty");
  EXPECT_THROW(reproduce({"1.1", "--out", "/dev/null/nowhere"}), RecordError);
}

TEST(Reproduce, AllExperimentsHaveUniqueNames) {
  std::set<std::string> names;
  for (const Experiment& experiment : all_experiments()) {
    EXPECT_TRUE(names.insert(experiment.id).second) << experiment.id;
    EXPECT_NE(experiment.title, "") << experiment.id;
    EXPECT_NE(experiment.run, nullptr) << experiment.id;
    for (const std::string& figure : experiment.figures) {
      EXPECT_TRUE(names.insert(figure).second) << figure;
      EXPECT_TRUE(figure.starts_with("fig-")) << figure;
    }
  }
}

}  // namespace
}  // namespace incognita
