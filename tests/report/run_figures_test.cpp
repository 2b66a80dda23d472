#include "incognita/report/run_figures.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/csv_table.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/report/child_process.hpp"
#include "tests/record/file_size_limit.hpp"
#include "tests/record/synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::Scratch;
using testing::SyntheticRun;

void record(const fs::path& folder, const SyntheticRun& run) {
  Recorder recorder(folder, RunInfo{});
  for (int i = 0; i < run.frames; ++i) recorder.publish(testing::synthetic_snapshot(run, i));
  recorder.finish(RunStatus::done, "");
}

void expect_figures(const fs::path& run, std::initializer_list<const char*> names) {
  std::size_t count = 0;
  for (const char* name : names) {
    EXPECT_TRUE(fs::exists(run / "figures" / (std::string(name) + ".gp"))) << name;
    const std::string svg = contents(run / "figures" / (std::string(name) + ".svg"));
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << name;
    EXPECT_NE(svg.find("<path"), std::string::npos) << name;
    count += 2;
  }
  EXPECT_EQ(static_cast<std::size_t>(
                std::distance(fs::directory_iterator(run / "figures"), fs::directory_iterator{})),
            count);
}

TEST(RunFigures, AreAllDrawn) {
  const Scratch scratch;
  SyntheticRun run;
  run.frames = 300;
  run.lost_from = 150;
  run.lost_to = 180;
  record(scratch / "run", run);
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  expect_figures(scratch / "run", {"map", "errors", "entropy", "decision"});
  EXPECT_NE(contents(scratch / "run/figures/map.svg").find("true path"), std::string::npos);
  EXPECT_NE(contents(scratch / "run/figures/errors.svg").find(">error<"), std::string::npos);
  EXPECT_NE(contents(scratch / "run/figures/decision.svg").find("forward"), std::string::npos);
}

TEST(RunFigures, UseNoMetersWhereTheScaleIsUnobservable) {
  const Scratch scratch;
  RunInfo info;
  info.ate_alignment = "sim3";
  Recorder recorder(scratch / "run", info);
  for (int i = 0; i < 60; ++i) {
    Snapshot snapshot = testing::synthetic_snapshot({}, i);
    Eigen::Vector3d& truth = snapshot.bodies[0].truth->position;
    truth = 3 * truth + Eigen::Vector3d(50, 0, 0);  // the estimate's unit is 3 m
    recorder.publish(snapshot);
  }
  recorder.finish(RunStatus::done, "");
  EXPECT_EQ(draw_run_figures(scratch / "run", AlignmentKind::sim3), std::vector<std::string>{});
  const std::string map = contents(scratch / "run/figures/map.svg"),
                    errors = contents(scratch / "run/figures/errors.svg");
  EXPECT_NE(map.find("x, arbitrary units (scale unobservable)"), std::string::npos);
  EXPECT_EQ(map.find("x, m<"), std::string::npos);
  EXPECT_NE(map.find("true path, aligned"), std::string::npos);
  EXPECT_EQ(errors.find("x, cm<"), std::string::npos);
  EXPECT_NE(errors.find("arbitrary units"), std::string::npos);
  // The truth is drawn over the estimate, not 50 m beside it
  const std::string script = contents(scratch / "run/figures/map.gp");
  const double right = std::stod(script.substr(script.find(':', script.find("set xrange")) + 1));
  EXPECT_LT(right, 10);
}

TEST(RunFigures, ShowSurveyedLandmarksAtTheirPositions) {
  const Scratch scratch;
  RunInfo info;
  info.survey = {{{2, {1, 2, 0}}, {3, {-1, 2, 0}}}, true};
  Recorder recorder(scratch / "run", info);
  for (int i = 0; i < 60; ++i) recorder.publish(testing::synthetic_snapshot({}, i));
  recorder.finish(RunStatus::done, "");
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  EXPECT_EQ(contents(scratch / "run/surveyed.csv"), "id,x,y,z\n2,1,2,0\n3,-1,2,0\n");
  EXPECT_NE(contents(scratch / "run/figures/map.svg").find(">surveyed<"), std::string::npos);
}

TEST(RunFigures, WithoutTruthShowSigmaBounds) {
  const Scratch scratch;
  SyntheticRun run;
  run.with_truth = false;
  record(scratch / "run", run);
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  EXPECT_EQ(contents(scratch / "run/figures/map.svg").find("true path"), std::string::npos);
  EXPECT_EQ(contents(scratch / "run/figures/errors.svg").find(">error<"), std::string::npos);
}

TEST(RunFigures, OfARunThatNeverStartedShowItsMapOnly) {
  const Scratch scratch;
  SyntheticRun run;
  run.frames = 10;
  run.starting = 10;
  record(scratch / "run", run);
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  expect_figures(scratch / "run", {"map"});
}

TEST(RunFigures, OfARunWithoutFramesAreAbsent) {
  const Scratch scratch;
  SyntheticRun run;
  run.frames = 0;
  record(scratch / "run", run);
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  expect_figures(scratch / "run", {});
}

TEST(RunFigures, OfASingleFrameAreDrawn) {
  const Scratch scratch;
  SyntheticRun run;
  run.frames = 16;  // one decision
  run.starting = 15;
  record(scratch / "run", run);
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  expect_figures(scratch / "run", {"map", "errors", "entropy", "decision"});
}

TEST(RunFigures, WithoutGnuplotLeaveTheScriptsAndWarn) {
  const Scratch scratch;
  record(scratch / "run", {});
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const auto warnings = draw_run_figures(scratch / "run");
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("gnuplot is not installed"), std::string::npos);
  EXPECT_TRUE(fs::exists(scratch / "run/figures/map.gp"));
  EXPECT_FALSE(fs::exists(scratch / "run/figures/map.svg"));
}

TEST(RunFigures, OnAFullDiskLeaveNoPartialFigure) {
  const Scratch scratch;
  record(scratch / "run", {});
  const testing::FileSizeLimit limit(6000);
  EXPECT_THROW(draw_run_figures(scratch / "run"), RecordError);
  EXPECT_FALSE(fs::exists(scratch / "run/figures/map.svg"));
}

TEST(RunFigures, QuoteNames) {
  const Scratch scratch;
  Recorder recorder(scratch / "run", RunInfo{});
  Snapshot snapshot = testing::synthetic_snapshot({}, 45);
  snapshot.bodies.at(0).decision.actions[0] = "'; system('touch hacked'); '`touch hacked`\\";
  snapshot.bodies.at(0).decision.chosen = 0;
  recorder.publish(snapshot);
  recorder.finish(RunStatus::done, "");
  EXPECT_EQ(draw_run_figures(scratch / "run"), std::vector<std::string>{});
  EXPECT_FALSE(fs::exists(scratch / "run/hacked"));
  EXPECT_FALSE(fs::exists("hacked"));
}

TEST(ChildProcess, ReportsItsExitStatus) {
  EXPECT_EQ(run_child({"false"}, "/")->exit_code, 1);
  EXPECT_EQ(run_child({"pwd"}, "/usr")->output, "/usr\n");
  EXPECT_EQ(run_child({"echo", "$HOME; `id`"}, "/")->output, "$HOME; `id`\n");
  EXPECT_FALSE(run_child({"no-such-program-anywhere"}, "/"));
}

TEST(Csv, ReadsQuotesAndRefusesRaggedRows) {
  const Scratch scratch;
  testing::write(scratch / "a.csv", "t,\"a,b\"\n1,2\n2,x\n");
  const CsvTable table = read_csv(scratch / "a.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"t", "a,b"}));
  EXPECT_EQ(table.numbers("a,b")[0], 2);
  EXPECT_TRUE(std::isnan(table.numbers("a,b")[1]));
  EXPECT_THROW(table.numbers("c"), InputError);
  testing::write(scratch / "b.csv", "t,a\n1,2\n1\n");
  EXPECT_THROW(read_csv(scratch / "b.csv"), InputError);
  EXPECT_THROW(read_csv(scratch / "c.csv"), InputError);
}

}  // namespace
}  // namespace incognita
