#include "incognita/app/commands/evaluate.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "incognita/record/recorder.hpp"
#include "tests/app/captured.hpp"
#include "tests/record/synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Json = nlohmann::json;
using testing::Scratch;

using Result = testing::Captured;

Result evaluate(std::vector<std::string> words) {
  words.insert(words.begin(), "evaluate");
  return testing::captured(add_evaluate, words);
}

void record(const std::filesystem::path& folder, const std::string& alignment) {
  RunInfo info;
  info.ate_alignment = alignment;
  Recorder recorder(folder, info);
  for (int i = 0; i < 120; ++i) recorder.publish(testing::synthetic_snapshot({}, i));
  recorder.finish(RunStatus::done, "");
}

const char* truth_text = "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n3 1 1 1 0 0 0 1\n";
/// Twice as large, and one meter higher.
const char* doubled_text = "0 0 0 1 0 0 0 1\n1 2 0 1 0 0 0 1\n2 2 2 1 0 0 0 1\n3 2 2 3 0 0 0 1\n";

TEST(Evaluate, ARunHasTheErrorsOfItsSummary) {
  const Scratch scratch;
  const std::string run = scratch / "run";
  record(run, "none");
  const Result result = evaluate({run, "--json"});
  EXPECT_EQ(result.code, 0);
  const Json json = Json::parse(result.out),
             summary = Json::parse(testing::contents(scratch / "run/summary.json"));
  EXPECT_EQ(json["alignment"], "none");
  EXPECT_EQ(json["matched"], 117);
  EXPECT_EQ(json["truth_poses"], 120);
  EXPECT_NEAR(json["ate_m"]["rmse"].get<double>(), summary["ate_m"].get<double>(), 1e-12);
  EXPECT_NEAR(json["mean_nees"].get<double>(), summary["mean_nees"].get<double>(), 1e-9);
  EXPECT_EQ(json["rpe"]["delta_s"], 1.0);
  EXPECT_EQ(json["rpe"]["translation_m"]["count"], 87);
}

TEST(Evaluate, UsesTheAlignmentOfTheRun) {
  const Scratch scratch;
  const std::string run = scratch / "run";
  record(run, "sim3");
  EXPECT_EQ(Json::parse(evaluate({run, "--json"}).out)["alignment"], "sim3");
  const Result none = evaluate({run, "--json", "--align", "none"});
  EXPECT_TRUE(Json::parse(none.out).contains("mean_nees"));
  const Result se3 = evaluate({run, "--json", "--align", "se3"});
  EXPECT_FALSE(Json::parse(se3.out).contains("mean_nees"));
  EXPECT_NE(se3.err.find("no NEES"), std::string::npos);
}

TEST(Evaluate, EstimatesAScale) {
  const Scratch scratch;
  testing::write(scratch / "truth", truth_text);
  testing::write(scratch / "estimate", doubled_text);
  const std::string truth = scratch / "truth", estimate = scratch / "estimate";
  const Json sim3 = Json::parse(evaluate({estimate, "--truth", truth, "--align", "sim3", "--json"}).out);
  EXPECT_NEAR(sim3["scale"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(sim3["ate_m"]["max"].get<double>(), 0, 1e-12);
  const Json se3 = Json::parse(evaluate({estimate, "--truth", truth, "--json"}).out);
  EXPECT_EQ(se3["alignment"], "se3");
  EXPECT_EQ(se3["scale"], 1.0);
  EXPECT_GT(se3["ate_m"]["rmse"].get<double>(), 0.3);
  EXPECT_NEAR(se3["rpe"]["translation_m"]["rmse"].get<double>(), 1, 1e-9);
  EXPECT_NE(evaluate({estimate, "--truth", truth}).out.find("matched 4 of 4"), std::string::npos);
}

TEST(Evaluate, WithoutMatchesFailsWithTheReason) {
  const Scratch scratch;
  testing::write(scratch / "truth", truth_text);
  testing::write(scratch / "estimate", "100 0 0 0 0 0 0 1\n101 0 0 0 0 0 0 1\n");
  const Result result = evaluate({scratch / "estimate", "--truth", scratch / "truth", "--json"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("0 of 2"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--max-dt"), std::string::npos) << result.err;
}

TEST(Evaluate, RefusesInvalidInput) {
  const Scratch scratch;
  const std::string truth = scratch / "truth";
  testing::write(truth, truth_text);
  EXPECT_THROW(evaluate({truth}), InputError);                               // no truth
  EXPECT_THROW(evaluate({"/nowhere", "--truth", truth}), InputError);        // no file
  EXPECT_THROW(evaluate({scratch.folder(), "--truth", truth}), InputError);  // not a run
  EXPECT_THROW(evaluate({truth, "--truth", truth, "--align", "se4"}), InputError);
  EXPECT_THROW(evaluate({truth, "--truth", truth, "--max-dt", "-1"}), CLI::ValidationError);
}

}  // namespace
}  // namespace incognita
