#include "incognita/record/recorder.hpp"

#include <gtest/gtest.h>
#include <matio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "file_size_limit.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/number.hpp"
#include "incognita/record/files/tum.hpp"
#include "incognita/record/snapshot/series.hpp"
#include "mcap_reader.hpp"
#include "schema.hpp"
#include "synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::FileSizeLimit;
using testing::Json;
using testing::lines;
using testing::Scratch;
using testing::SyntheticRun;

RunInfo info() {
  RunInfo info;
  info.effective_toml = "[run]\nseed = 5\n";
  info.seed = 5;
  info.version = "0.1.0";
  info.extra = {{"scenario", std::string("synthetic")}, {"realtime_factor", 1.5}};
  return info;
}

RunOutcome record(const fs::path& folder, const SyntheticRun& run, const RunInfo& about = info(),
                  double pace_ms = 5) {
  Recorder recorder(folder, about);
  for (int i = 0; i < run.frames; ++i) recorder.publish(testing::synthetic_snapshot(run, i, pace_ms));
  return recorder.finish(RunStatus::done, "");
}

Json summary(const fs::path& folder) { return Json::parse(contents(folder / "summary.json")); }

Json schema() {
  return Json::parse(contents(fs::path(INCOGNITA_SOURCE_DIR) / "docs/schemas/summary.schema.json"));
}

std::size_t logged_snapshots(const fs::path& folder) {
  return testing::read_mcap(contents(folder / "run.mcap")).count("/snapshot");
}

std::size_t columns(const std::string& line) { return std::count(line.begin(), line.end(), ',') + 1; }

/// Rows below the header; all must be as wide as it.
std::size_t rows(const fs::path& csv) {
  const auto all = lines(csv);
  if (all.empty()) return 0;
  for (const std::string& line : all) EXPECT_EQ(columns(line), columns(all.front())) << csv << ": " << line;
  return all.size() - 1;
}

std::string cell(const fs::path& csv, std::size_t row, const std::string& column) {
  const auto all = lines(csv);
  std::stringstream header(all.front()), values(all[row + 1]);
  std::string name, value;
  while (std::getline(header, name, ',') && std::getline(values, value, ','))
    if (name == column) return value;
  return "no column " + column;
}

TEST(Recorder, WritesEveryFileOfARun) {
  const Scratch scratch;
  const fs::path run = scratch / "deep/er/run";
  SyntheticRun synthetic;
  synthetic.lost_from = 100;
  synthetic.lost_to = 110;
  EXPECT_EQ(record(run, synthetic).status, RunStatus::done);
  EXPECT_EQ(contents(run / "effective.toml"), info().effective_toml);
  EXPECT_EQ(read_trajectory(run / "truth.tum").size(), 120u);
  EXPECT_EQ(read_trajectory(run / "estimate.tum").size(), 107u);  // neither starting (3) nor lost (10)
  EXPECT_EQ(read_covariances(run / "covariance.csv").size(), 107u);
  EXPECT_EQ(rows(run / "series.csv"), 120u);
  EXPECT_EQ(rows(run / "timings.csv"), 120u);
  EXPECT_EQ(rows(run / "measurements.csv"), 960u);
  EXPECT_EQ(rows(run / "actions.csv"), 4u);
  EXPECT_EQ(rows(run / "map.csv"), 13u);
  EXPECT_EQ(logged_snapshots(run), 120u);
  EXPECT_EQ(lines(run / "map.csv").front(), "id,kind,x,y,z,pxx,pxy,pxz,pyy,pyz,pzz,detections");
  EXPECT_EQ(lines(run / "actions.csv").front(), "t,chosen,stay,forward,back,left,right,up,down");
  EXPECT_TRUE(
      lines(run / "series.csv").front().starts_with("t,state,matched,predicted,landmarks,sigma_position_m,"));
  // the stage `birth` begins late
  EXPECT_EQ(lines(run / "timings.csv").front(), "t,search_ms,frame_ms,birth_ms");
  EXPECT_EQ(contents(run / "series.csv").find("_ms,"), std::string::npos);
}

TEST(Recorder, WritesTheSnapshotsValues) {
  const Scratch scratch;
  const SyntheticRun synthetic;
  record(scratch / "run", synthetic);
  const Snapshot snapshot = testing::synthetic_snapshot(synthetic, 50);
  const Trajectory estimate = read_trajectory(scratch / "run/estimate.tum");
  EXPECT_EQ(estimate[47].t, snapshot.tick.t);  // exactly: numbers are written with all their digits
  EXPECT_EQ(estimate[47].position, snapshot.bodies[0].estimate.position);
  EXPECT_TRUE(estimate[47].orientation.isApprox(snapshot.bodies[0].estimate.orientation, 1e-15));
  EXPECT_EQ(read_covariances(scratch / "run/covariance.csv")[47].covariance, snapshot.bodies[0].covariance);
  const fs::path series = scratch / "run/series.csv";
  EXPECT_EQ(cell(series, 0, "state"), "starting");
  EXPECT_EQ(cell(series, 0, "sigma_position_m"), "nan");
  EXPECT_EQ(cell(series, 50, "state"), "tracking");
  EXPECT_EQ(cell(series, 50, "landmarks"), "5");
  EXPECT_NEAR(*parse_number(cell(series, 50, "sigma_position_m")), 0.02, 1e-12);
  EXPECT_NEAR(*parse_number(cell(series, 50, "two_sigma_rotz_rad")), 0.02, 1e-12);
  EXPECT_NEAR(*parse_number(cell(series, 50, "error_x_m")),
              snapshot.bodies[0].estimate.position.x() - snapshot.bodies[0].truth->position.x(), 1e-12);
  EXPECT_EQ(*parse_number(cell(series, 50, "nis")), snapshot.nis);
  EXPECT_EQ(cell(scratch / "run/actions.csv", 1, "chosen"), "back");
  EXPECT_EQ(cell(scratch / "run/measurements.csv", 0, "kind"), "anchor");
  EXPECT_EQ(cell(scratch / "run/measurements.csv", 5, "measured_1"), "nan");
  EXPECT_EQ(cell(scratch / "run/measurements.csv", 5, "outcome"), "not-found");
  EXPECT_EQ(cell(scratch / "run/measurements.csv", 7, "kind"), "ray");
}

TEST(Recorder, SummarizesARun) {
  const Scratch scratch;
  SyntheticRun synthetic;
  synthetic.frames = 600;
  synthetic.lost_from = 100;
  synthetic.lost_to = 110;
  record(scratch / "run", synthetic);
  const Json json = summary(scratch / "run");
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(json["status"], "done");
  EXPECT_EQ(json["frames"], 600);
  EXPECT_EQ(json["lost_frames"], 10);
  EXPECT_EQ(json["tracked_frames"], 587);
  EXPECT_EQ(json["landmarks"], 59);
  EXPECT_EQ(json["anchors"], 2);
  EXPECT_EQ(json["decisions"], 20);
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["version"], "0.1.0");
  EXPECT_EQ(json["scenario"], "synthetic");
  EXPECT_EQ(json["realtime_factor"], 1.5);
  EXPECT_EQ(json["ate_alignment"], "none");
  EXPECT_NEAR(json["ate_m"].get<double>(), 0.02 * std::sqrt(3), 0.004);
  EXPECT_NEAR(json["mean_nees"].get<double>(), 1, 0.12);  // standard error sqrt(2/6/587) = 0.024
  EXPECT_NEAR(json["mean_nis"].get<double>(), 1, 0.1);
  EXPECT_LT(json["overconfident_frames"].get<int>(), 10);  // expected 600 * 0.0027 = 1.6
  EXPECT_EQ(json["timing_ms"]["frame"]["median"], 5.0);
  EXPECT_EQ(json["timing_ms"]["birth"]["p99"], 1.0);
}

TEST(Recorder, WritesTheTrajectoryAfterBundleAdjustment) {
  const Scratch scratch;
  const SyntheticRun synthetic;
  {
    Recorder recorder(scratch / "run", info());
    Trajectory truth;
    for (int i = 0; i < synthetic.frames; ++i) {
      Snapshot snapshot = testing::synthetic_snapshot(synthetic, i);
      if (has_pose(snapshot.bodies[0])) {
        truth.push_back(*snapshot.bodies[0].truth);
        snapshot.keyframes = {snapshot.bodies[0].estimate, truth};
      }
      recorder.publish(snapshot);
    }
    EXPECT_EQ(recorder.finish(RunStatus::done, "").status, RunStatus::done);
  }
  const Json json = summary(scratch / "run");
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_GT(json["ate_m"].get<double>(), 0.02);
  EXPECT_LT(json["ate_adjusted_m"].get<double>(), 1e-12);
  const Trajectory adjusted = read_trajectory(scratch / "run/adjusted.tum");
  EXPECT_EQ(adjusted.size(), read_trajectory(scratch / "run/estimate.tum").size());
  EXPECT_EQ(adjusted.back().t, testing::synthetic_snapshot(synthetic, synthetic.frames - 1).tick.t);
  // Without adjusted keyframes an earlier file goes
  record(scratch / "run", synthetic);
  EXPECT_FALSE(fs::exists(scratch / "run/adjusted.tum"));
  EXPECT_FALSE(summary(scratch / "run").contains("ate_adjusted_m"));
}

/// Report of a filter with one anchor, with more directions than fit.
ObservabilityReport observability() {
  ObservabilityReport report;
  report.anchors = 1;
  report.ideal_nullity = 4;
  report.information = {200, 197, 1e-3, 5, 1e-6, false};
  report.spurious_information = 1;
  report.quantities = {{"x", "m", false, std::nullopt, false, false, std::nullopt},
                       {"scale", "1", false, 0.02, true, false, 0.03}};
  for (int i = 0; i < 300; ++i)
    report.without_information.push_back("depth of landmark " + std::to_string(i));
  return report;
}

TEST(Recorder, ReportsObservability) {
  const Scratch scratch;
  Recorder recorder(scratch / "run", info());
  recorder.note(observability());
  recorder.finish(RunStatus::done, "");
  const Json json = summary(scratch / "run"), &said = json["observability"];
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(said["rank"], 197);
  EXPECT_EQ(said["ideal_rank"], 196);
  EXPECT_EQ(said["nullity"], 3);
  EXPECT_EQ(said["gap"], 5e6);
  EXPECT_EQ(said["directions"][0]["estimated_sigma"], nullptr);
  EXPECT_EQ(said["directions"][1]["estimated_sigma"], 0.02);
  EXPECT_EQ(said["without_information"].size(), 50u);
  EXPECT_EQ(said["without_information_count"], 300);
}

TEST(Recorder, ReportsWhyObservabilityIsUnknown) {
  const Scratch scratch;
  ObservabilityReport report;
  report.uncovered = "the filter decorrelates its map";
  Recorder recorder(scratch / "run", info());
  recorder.note(report);
  recorder.finish(RunStatus::done, "");
  const Json json = summary(scratch / "run");
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(json["observability"]["followed"], false);
  EXPECT_EQ(json["observability"]["why_not"], report.uncovered);
  EXPECT_FALSE(json["observability"].contains("rank"));
}

TEST(Recorder, DetectsOverconfidence) {
  const Scratch scratch;
  SyntheticRun synthetic;
  synthetic.error_factor = 5;
  record(scratch / "run", synthetic);
  const Json json = summary(scratch / "run");
  EXPECT_NEAR(json["mean_nees"].get<double>(), 25, 5);
  EXPECT_GT(json["overconfident_frames"].get<int>(), 90);
}

TEST(Recorder, DoesNotCompareWithATruthInAnotherFrame) {
  const Scratch scratch;
  RunInfo free = info();
  free.ate_alignment = "sim3";
  record(scratch / "run", {}, free);
  const Json json = summary(scratch / "run");
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(json["ate_alignment"], "sim3");
  EXPECT_TRUE(json["mean_nees"].is_null());
  EXPECT_LT(json["ate_m"].get<double>(), 0.04);
  EXPECT_EQ(cell(scratch / "run/series.csv", 50, "error_x_m"), "no column error_x_m");
}

TEST(Recorder, WithoutTruthReportsNoErrors) {
  const Scratch scratch;
  SyntheticRun synthetic;
  synthetic.with_truth = false;
  record(scratch / "run", synthetic);
  const Json json = summary(scratch / "run");
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_FALSE(json.contains("ate_m"));
  EXPECT_FALSE(fs::exists(scratch / "run/truth.tum"));
}

TEST(Recorder, WritesTheSameBytesForTheSameRun) {
  const Scratch scratch;
  record(scratch / "a", {}, info(), 5);
  record(scratch / "b", {}, info(), 7);  // another machine, another speed
  for (const char* file : {"effective.toml", "estimate.tum", "truth.tum", "covariance.csv", "actions.csv",
                           "map.csv", "map.ply", "series.csv", "measurements.csv", "run.mcap"}) {
    EXPECT_EQ(contents(scratch / "a" / file), contents(scratch / "b" / file)) << file;
    EXPECT_FALSE(contents(scratch / "a" / file).empty()) << file;
  }
  EXPECT_NE(contents(scratch / "a" / "timings.csv"), contents(scratch / "b" / "timings.csv"));
}

TEST(Recorder, WritesAPlyThatParses) {
  const Scratch scratch;
  record(scratch / "run", {});
  const auto ply = lines(scratch / "run/map.ply");
  EXPECT_EQ(ply[0], "ply");
  const auto body = std::find(ply.begin(), ply.end(), "end_header");
  ASSERT_NE(body, ply.end());
  EXPECT_EQ(ply.end() - body - 1, 13);
  EXPECT_NE(std::find(ply.begin(), ply.end(), "element vertex 13"), ply.end());
  for (auto line = body + 1; line != ply.end(); ++line)
    EXPECT_EQ(std::count(line->begin(), line->end(), ' '), 5);
}

TEST(Recorder, WritesAMatFileThatReadsBack) {
  const Scratch scratch;
  const SyntheticRun synthetic;
  record(scratch / "run", synthetic);
  mat_t* mat = Mat_Open((scratch / "run/series.mat").c_str(), MAT_ACC_RDONLY);
  ASSERT_NE(mat, nullptr);
  for (const char* name :
       {"t", "state", "entropy_total_nats", "nis", "error_x_m", "two_sigma_x_m", "timing_ms_frame"}) {
    matvar_t* variable = Mat_VarRead(mat, name);
    ASSERT_NE(variable, nullptr) << name;
    EXPECT_EQ(variable->dims[0], 120u) << name;
    const double* values = static_cast<const double*>(variable->data);
    if (std::string(name) == "t") {
      EXPECT_EQ(values[50], 50 / 30.0);
    }
    if (std::string(name) == "timing_ms_frame") {
      EXPECT_EQ(values[50], 5);
    }
    if (std::string(name) == "state") {
      EXPECT_EQ(values[50], static_cast<double>(TrackingState::tracking));
    }
    Mat_VarFree(variable);
  }
  matvar_t* names = Mat_VarRead(mat, "state_names");
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->dims[0], 5u);
  const matvar_t* word = Mat_VarGetCell(names, 1);
  EXPECT_EQ(std::string(static_cast<const char*>(word->data), word->dims[1]), "tracking");
  Mat_VarFree(names);
  Mat_Close(mat);
}

TEST(Recorder, WhenKilledLeavesAValidSummaryAndCompleteRows) {
  const Scratch scratch;
  const fs::path run = scratch / "run";
  const pid_t child = ::fork();
  if (child == 0) {
    Recorder recorder(run, info());
    for (int i = 0;; ++i) {
      recorder.publish(testing::synthetic_snapshot({}, i % 1000000));
      if (i == 200) ::kill(::getpid(), SIGKILL);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const Json json = summary(run);
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_EQ(json["reason"], "the program ended before the run did");
  EXPECT_GT(json["frames"], 100);
  EXPECT_GT(rows(run / "series.csv"), 150u);  // all but the last second
  EXPECT_GT(read_trajectory(run / "estimate.tum").size(), 150u);
  EXPECT_EQ(contents(run / "series.csv").back(), '\n');
  EXPECT_GT(logged_snapshots(run), 130u);  // all but the last two seconds
}

TEST(Recorder, WhenKilledAtTheStartLeavesAValidSummary) {
  const Scratch scratch;
  { const Recorder recorder(scratch / "run", info()); }
  const Json json = summary(scratch / "run");
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_EQ(fs::file_size(scratch / "run/summary.json"), 16384u);
}

TEST(Recorder, KeepsFilesOfTheUser) {
  const Scratch scratch;
  for (const char* name : {"run/figures/map.svg", "run/figures/map-final.svg", "run/frames/frame-000001.png",
                           "run/frames/frame-copy.png", "run/frames/frame-1.png", "run/notes.txt"})
    scratch.write(name, "mine");
  const Recorder recorder(scratch / "run", info());
  for (const char* gone : {"figures/map.svg", "frames/frame-000001.png"})
    EXPECT_FALSE(fs::exists(scratch / "run" / gone)) << gone;
  for (const char* kept :
       {"figures/map-final.svg", "frames/frame-copy.png", "frames/frame-1.png", "notes.txt"})
    EXPECT_TRUE(fs::exists(scratch / "run" / kept)) << kept;
}

TEST(Recorder, ARunWithoutFramesIsComplete) {
  const Scratch scratch;
  Recorder recorder(scratch / "run", info());
  recorder.finish(RunStatus::failed, "no image came");
  EXPECT_EQ(summary(scratch / "run")["reason"], "no image came");
  EXPECT_TRUE(contents(scratch / "run/summary.json").ends_with("}\n")) << "no blanks behind the last word";
  EXPECT_EQ(rows(scratch / "run/series.csv"), 0u);
  for (const char* file : {"series.csv", "actions.csv", "map.csv", "timings.csv", "map.ply", "series.mat"})
    EXPECT_TRUE(fs::exists(scratch / "run" / file)) << file;
  EXPECT_EQ(logged_snapshots(scratch / "run"), 0u);
}

TEST(Recorder, OnAFullDiskKeepsWhatItHasAndReportsIt) {
  const Scratch scratch;
  const fs::path run = scratch / "run";
  std::string reason;
  RunOutcome outcome;
  {
    const FileSizeLimit limit(20000);
    Recorder recorder(run, info());
    try {
      for (int i = 0; i < 5000; ++i) recorder.publish(testing::synthetic_snapshot({}, i));
    } catch (const RecordError& error) {
      reason = error.what();
    }
    outcome = recorder.finish(RunStatus::failed, reason);
  }
  EXPECT_NE(reason.find(".csv"), std::string::npos) << reason;
  EXPECT_NE(reason.find("ulimit"), std::string::npos) << reason;
  EXPECT_EQ(outcome.status, RunStatus::failed);
  const Json json = summary(run);
  EXPECT_EQ(testing::problems(json, schema()), "");
  EXPECT_EQ(json["status"], "failed");
  EXPECT_TRUE(json["reason"].get<std::string>().starts_with(reason));
  EXPECT_GT(json["frames"], 10);
  for (const char* file : {"series.csv", "measurements.csv", "covariance.csv"}) {
    EXPECT_GT(rows(run / file), 5u) << file;
    EXPECT_EQ(contents(run / file).back(), '\n') << file;
  }
  EXPECT_NO_THROW(logged_snapshots(run));
}

TEST(Recorder, FailsWithoutTheFileThatCannotBeWritten) {
  const Scratch scratch;
  Recorder recorder(scratch / "run", info());
  for (int i = 0; i < 120; ++i) recorder.publish(testing::synthetic_snapshot({}, i));
  fs::create_directory(scratch / "run/map.ply");  // blocks the file of this name
  const RunOutcome outcome = recorder.finish(
      RunStatus::done, "",
      [](const fs::path&) -> std::vector<std::string> { return {"gnuplot is not installed"}; });
  EXPECT_EQ(outcome.status, RunStatus::failed);
  EXPECT_NE(outcome.reason.find("map.ply"), std::string::npos);
  const Json json = summary(scratch / "run");
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["warnings"][0], "gnuplot is not installed");
  EXPECT_EQ(rows(scratch / "run/map.csv"), 13u);
  EXPECT_TRUE(fs::exists(scratch / "run/series.mat"));
}

TEST(Recorder, LeavesNothingWhenItCannotStart) {
  const Scratch scratch;
  testing::write(scratch / "file", "mine\n");
  EXPECT_THROW(Recorder(scratch / "file", info()), RecordError);
  EXPECT_THROW(Recorder(scratch / "file/run", info()), RecordError);
  {
    const FileSizeLimit limit(8000);  // not enough for the summary
    EXPECT_THROW(Recorder(scratch / "a/b/run", info()), RecordError);
  }
  EXPECT_EQ(contents(scratch / "file"), "mine\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder()), fs::directory_iterator{}), 1);
  if (::geteuid() == 0) return;  // root may write anywhere
  fs::create_directory(scratch / "locked");
  fs::permissions(scratch / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(Recorder(scratch / "locked", info()), RecordError);
  EXPECT_THROW(Recorder(scratch / "locked/run", info()), RecordError);
  EXPECT_TRUE(fs::is_empty(scratch / "locked"));
  fs::permissions(scratch / "locked", fs::perms::owner_all);
}

TEST(Recorder, ReplacesAnEarlierRunAndNothingElse) {
  const Scratch scratch;
  record(scratch / "run", {});
  testing::write(scratch / "run/notes.txt", "mine\n");
  fs::create_directory(scratch / "run/figures");
  testing::write(scratch / "run/figures/map.svg", "old");
  SyntheticRun shorter;
  shorter.frames = 10;
  shorter.with_truth = false;
  record(scratch / "run", shorter);
  EXPECT_EQ(rows(scratch / "run/series.csv"), 10u);
  EXPECT_FALSE(fs::exists(scratch / "run/truth.tum"));
  EXPECT_FALSE(fs::exists(scratch / "run/figures"));
  EXPECT_EQ(contents(scratch / "run/notes.txt"), "mine\n");
}

TEST(Recorder, RefusesAReservedField) {
  const Scratch scratch;
  Recorder recorder(scratch / "run", info());
  EXPECT_THROW(recorder.note("status", std::string("fine")), std::invalid_argument);
  recorder.note("scenario", std::string("another"));
  recorder.finish(RunStatus::done, "");
  EXPECT_EQ(summary(scratch / "run")["scenario"], "another");
}

TEST(SummarySchema, RefusesInvalidSummaries) {
  const Scratch scratch;
  record(scratch / "run", {});
  Json json = summary(scratch / "run");
  json["status"] = "fine";
  EXPECT_NE(testing::problems(json, schema()), "");
  json["status"] = "done";
  json.erase("frames");
  EXPECT_NE(testing::problems(json, schema()), "");
  json["frames"] = 1;
  json.erase("mean_nees");
  EXPECT_NE(testing::problems(json, schema()), "");
}

}  // namespace
}  // namespace incognita
