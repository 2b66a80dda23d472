// Complete runs in the rendered room: repeated, interrupted, killed, and with a covered lens.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <sstream>
#include <thread>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Circumstances;
using testing::Ended;
using testing::Program;
using testing::Scratch;
using testing::Words;

Words room_for(const std::string& seconds, const std::string& out, const Words& more = {}) {
  Words words = {"run", "room", "--duration", seconds, "--out", out, "--no-figures"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ProgramRun, SameSeedSameBytes) {
  const Scratch scratch;
  for (const char* out : {"one", "two"})
    EXPECT_EQ(testing::incognita(room_for("3", out), scratch.folder()).code, 0);
  const auto one = scratch.folder() / "one", two = scratch.folder() / "two";
  const std::set<std::string> files = testing::everything_in(one);
  EXPECT_EQ(files, testing::everything_in(two));
  for (const char* file :
       {"effective.toml", "estimate.tum", "truth.tum", "covariance.csv", "series.csv", "measurements.csv",
        "actions.csv", "map.csv", "map.ply", "timings.csv", "series.mat", "summary.json"})
    EXPECT_TRUE(files.contains(file)) << file;
  for (const std::string& file : files) {
    if (file == "timings.csv" || file == "series.mat" || file == "summary.json") continue;
    EXPECT_TRUE(testing::contents(one / file) == testing::contents(two / file)) << file;
  }
  nlohmann::json first = testing::summary_of(one), second = testing::summary_of(two);
  first.erase("timing_ms");
  second.erase("timing_ms");
  EXPECT_EQ(first, second);
  EXPECT_EQ(first["frames"], 90);
  testing::expect_whole_tables(one);
}

// The user's question: "What is the scale?"
TEST(ProgramRun, ReportsWhatFixesTheScale) {
  const Scratch scratch;
  const Ended anchored = testing::incognita(room_for("2", "anchored"), scratch.folder());
  EXPECT_SAYS(anchored.err,
              "position: fixed by 4 anchors\norientation: fixed by 4 anchors\nscale: fixed by 4 anchors\n");
  const nlohmann::json said = testing::summary_of(scratch.folder() / "anchored")["observability"];
  EXPECT_EQ(said["ideal_nullity"], 0);
  EXPECT_EQ(said["nullity"], 0);
  EXPECT_EQ(said["directions"].back()["name"], "scale");
  EXPECT_TRUE(said["directions"].back()["gained"]);
  EXPECT_LT(said["directions"].back()["estimated_sigma"], 0.05);
  const Words free = {"--set", "start.from=free"};
  EXPECT_SAYS(testing::incognita(room_for("2", "free", free), scratch.folder()).err, "scale: unobservable");
  EXPECT_EQ(testing::summary_of(scratch.folder() / "free")["observability"]["ideal_nullity"], 7);
}

TEST(ProgramRun, OmitsObservabilityOnRequest) {
  const Scratch scratch;
  const Words off = {"--set", "run.observability=false"};
  const Ended ended = testing::incognita(room_for("1", "run", off), scratch.folder());
  EXPECT_EQ(ended.err.find("anchors"), std::string::npos);
  const nlohmann::json summary = testing::summary_of(scratch.folder() / "run");
  EXPECT_FALSE(summary.contains("observability"));
  EXPECT_FALSE(summary["timing_ms"].contains("watch"));
}

/// Rows of the table of matches by kind and outcome.
int matches_with(const std::filesystem::path& run, const std::string& kind, const std::string& outcome) {
  std::istringstream table(testing::contents(run / "measurements.csv"));
  int found = 0;
  for (std::string row; std::getline(table, row);)
    found += row.find("," + kind + ",") != std::string::npos && row.find("," + outcome) != std::string::npos;
  return found;
}

// Thesis C.3: a depth is found by a search along a line, then the feature becomes a point of the map and is
// matched
TEST(ProgramRun, DepthLinesConvergeToPoints) {
  const Scratch scratch;
  const Words lines = {"--set", "landmark_initialization.method=depth-line",
                       "--set", "sensor.sigma_pixel_px=0.4",
                       "--set", "sensor.sigma_lasting_px=0"};
  ASSERT_EQ(testing::incognita(room_for("10", "run", lines), scratch.folder()).code, 0);
  const auto run = scratch.folder() / "run";
  const nlohmann::json summary = testing::summary_of(run);
  EXPECT_EQ(summary["lost_frames"], 0);
  EXPECT_GE(summary["landmarks"], 8);
  EXPECT_LT(summary["ate_m"], 0.01);
  EXPECT_LT(summary["mean_nees"], 2);
  EXPECT_GT(matches_with(run, "ray", "matched"), 50);
  EXPECT_GT(matches_with(run, "landmark", "matched"), 500);
}

/// Errors that last are states for each possible match: the state is too large for the analysis from the first image on.
TEST(ProgramRun, SaysThatTheStateIsTooLargeForItsObservability) {
  const Scratch scratch;
  const Words many = {"--set", "search.max_measurements=250", "--set", "map.max_landmarks=250"};
  ASSERT_EQ(testing::incognita(room_for("1", "run", many), scratch.folder()).code, 0);
  const nlohmann::json report = testing::summary_of(scratch.folder() / "run")["observability"];
  EXPECT_EQ(report["followed"], false);
  EXPECT_HAS(report["why_not"].get<std::string>(), "more than 900 errors");
}

/// The smallest distance in px between two matches of map features in one frame.
double nearest_matches(const std::filesystem::path& run) {
  std::map<std::string, std::vector<std::pair<double, double>>> by_frame;
  for (const std::string& row : testing::lines(run / "measurements.csv")) {
    std::istringstream cells(row);
    std::vector<std::string> cell;
    for (std::string one; std::getline(cells, one, ',');) cell.push_back(one);
    if (cell.back() != "matched" || cell[4] == "ray") continue;
    by_frame[cell[0]].push_back({std::stod(cell[9]), std::stod(cell[10])});
  }
  double nearest = 1e9;
  for (const auto& [t, positions] : by_frame)
    for (std::size_t a = 0; a < positions.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        nearest = std::min(nearest, std::hypot(positions[a].first - positions[b].first,
                                               positions[a].second - positions[b].second));
  return nearest;
}

// One corner mapped twice would count its information twice
TEST(ProgramRun, NoCornerIsMappedTwice) {
  for (const char* seed : {"1", "4", "6"}) {  // where anchors come too near to be searched for
    const Scratch scratch;
    const Words many = {"--set", "landmark_initialization.max_new_per_frame=5", "--seed", seed,
                        "--no-figures"};
    ASSERT_EQ(testing::incognita(room_for("8", "run", many), scratch.folder()).code, 0);
    const double nearest = nearest_matches(scratch.folder() / "run");
    EXPECT_GT(nearest, 2.5) << "seed " << seed;
    EXPECT_LT(nearest, 100);
  }
}

TEST(ProgramRun, AnotherSeedGivesAnotherRun) {
  const Scratch scratch;
  for (const char* seed : {"1", "2"})
    EXPECT_EQ(testing::incognita(room_for("0.5", seed, {"--seed", seed}), scratch.folder()).code, 0);
  for (const char* file : {"truth.tum", "estimate.tum", "measurements.csv"}) {
    EXPECT_NE(testing::contents(scratch.folder() / "1" / file),
              testing::contents(scratch.folder() / "2" / file))
        << file;
  }
}

TEST(ProgramRun, TheEffectiveScenarioGivesTheSameRun) {
  const Scratch scratch;
  const Words changed = {"--seed", "5", "--set", "room.boxes=3", "--set", "camera.fu_px=194.3"};
  EXPECT_EQ(testing::incognita(room_for("0.5", "one", changed), scratch.folder()).code, 0);
  EXPECT_EQ(testing::incognita({"run", "one/effective.toml", "--out", "two"}, scratch.folder()).code, 0);
  for (const char* file : {"truth.tum", "estimate.tum", "measurements.csv", "map.csv"}) {
    EXPECT_TRUE(testing::contents(scratch.folder() / "one" / file) ==
                testing::contents(scratch.folder() / "two" / file))
        << file;
  }
}

/// Interrupted halfway, with the given number of signals.
void expect_interrupted(int signal, int times) {
  const Scratch scratch;
  const auto run = scratch.folder() / "run";
  Program program(room_for("3600", "run"), Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(run / "series.csv", 20));
  for (int i = 0; i < times; ++i) program.signal(signal);
  const Ended ended = program.wait();
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.err, "interrupted, stopped at t = ");
  const nlohmann::json summary = testing::summary_of(run);
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_SAYS(summary["reason"].get<std::string>(), "stopped at t = ");
  EXPECT_EQ(testing::lines(run / "series.csv").size(), summary["frames"].get<std::size_t>() + 1);
  EXPECT_EQ(testing::lines(run / "estimate.tum").size(), summary["tracked_frames"].get<std::size_t>() + 1);
  for (const char* last : {"map.csv", "map.ply", "series.mat"}) EXPECT_TRUE(exists(run / last)) << last;
  testing::expect_whole_tables(run);
}

TEST(ProgramRun, InterruptedClosesItsFiles) { expect_interrupted(SIGINT, 1); }
TEST(ProgramRun, TerminatedTwiceStillClosesItsFiles) { expect_interrupted(SIGTERM, 2); }
TEST(ProgramRun, HangupClosesItsFiles) { expect_interrupted(SIGHUP, 1); }

TEST(ProgramRun, ManyInterruptsLeaveEveryFigure) {
  const Scratch scratch;
  const auto run = scratch.folder() / "run";
  Program program({"run", "room", "--duration", "3600", "--out", "run"}, Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(run / "series.csv", 20));
  for (int i = 0; i < 40; ++i) {
    program.signal_group(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(program.wait().code, 1);
  for (const char* figure : {"map.svg", "errors.svg", "entropy.svg", "decision.svg"})
    EXPECT_TRUE(exists(run / "figures" / figure)) << figure;
  EXPECT_TRUE(testing::summary_of(run).value("warnings", nlohmann::json::array()).empty());
}

TEST(ProgramRun, WithoutEntropiesWritesEverythingElse) {
  const Scratch scratch;
  const auto run = scratch.folder() / "run";
  const Words words = {"run", "room", "--duration", "0.5", "--out", "run", "--set", "run.entropy=false"};
  EXPECT_EQ(testing::incognita(words, scratch.folder()).code, 0);
  EXPECT_TRUE(testing::summary_of(run).at("entropy").at("total").is_null());
  EXPECT_TRUE(exists(run / "figures/errors.svg"));
  EXPECT_FALSE(exists(run / "figures/entropy.svg"));
}

TEST(ProgramRun, ALensCoveredFromTheStartIsReported) {
  const Scratch scratch;
  const Words covered = {"--set", "room.cover_lens_from_s=0", "--set", "start.max_search_s=1"};
  const Ended ended = testing::incognita(room_for("2", "run", covered), scratch.folder());
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.err, "failed, never started: ");
}

TEST(ProgramRun, AnInterruptEndsTheWaitForTheClock) {
  const Scratch scratch;
  const Words slow = {"--realtime", "--set", "run.rate_hz=0.001"};
  Program program(room_for("3600", "run", slow), Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(scratch.folder() / "run/timings.csv", 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto asked = std::chrono::steady_clock::now();
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 1);
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(10));
  EXPECT_EQ(testing::summary_of(scratch.folder() / "run")["frames"], 1);
}

TEST(ProgramRun, KilledLeavesCompleteRows) {
  const Scratch scratch;
  const auto run = scratch.folder() / "run";
  Program program(room_for("3600", "run"), Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(run / "series.csv", 35));  // beyond the first second of the run
  program.signal(SIGKILL);
  EXPECT_EQ(program.wait().signal, SIGKILL);
  const nlohmann::json summary = testing::summary_of(run);
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(summary["reason"], "the program ended before the run did");
  EXPECT_GT(summary["frames"], 0);
  testing::expect_whole_tables(run);
}

TEST(ProgramRun, ACoveredLensIsReported) {
  const Scratch scratch;
  const auto run = scratch.folder() / "run";
  const Ended ended =
      testing::incognita(room_for("6", "run", {"--set", "room.cover_lens_from_s=2"}), scratch.folder());
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.err, ": lost: 10 frames in a row with fewer than 3 features matched; 0 of ");
  EXPECT_SAYS(ended.err, "failed, lost at the end: ");
  const nlohmann::json summary = testing::summary_of(run);
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_SAYS(summary["reason"].get<std::string>(), "features matched");
  EXPECT_EQ(summary["frames"], 180);
  EXPECT_GE(summary["lost_frames"], 180 - 60 - 10);  // declared within ten frames without matches
  EXPECT_EQ(summary["tracked_frames"].get<int>() + summary["lost_frames"].get<int>(), 180);
  const double last_pose_s = std::stod(testing::lines(run / "estimate.tum").back());
  EXPECT_GT(last_pose_s, 1.9);
  EXPECT_LT(last_pose_s, 2.0 + 10 / 30.0);
  testing::expect_whole_tables(run);
}

TEST(ProgramRun, IsNotStartedByOtherTexture) {
  const Scratch scratch;
  for (const char* heading : {"1.0", "3.1"}) {
    const Words turned_away = {"--set", std::string("room.start_heading_rad=") + heading};
    const Ended ended = testing::incognita(room_for("0.2", "run", turned_away), scratch.folder());
    EXPECT_EQ(ended.code, 1);
    EXPECT_SAYS(ended.err, "failed, never started: ");
    EXPECT_SAYS(ended.err, "target sheet");
    EXPECT_EQ(testing::summary_of(scratch.folder() / "run")["tracked_frames"], 0);
    EXPECT_EQ(testing::lines(scratch.folder() / "run/estimate.tum").size(), 1u);
  }
}

TEST(ProgramRun, KeepsFilesInAnExistingFolder) {
  const Scratch scratch;
  scratch.write("run/notes.txt", "mine");
  EXPECT_EQ(testing::incognita(room_for("1", "run"), scratch.folder()).code, 0);
  EXPECT_EQ(testing::incognita(room_for("0.1", "run"), scratch.folder()).code, 0);
  EXPECT_EQ(testing::contents(scratch.folder() / "run/notes.txt"), "mine");
  EXPECT_EQ(testing::lines(scratch.folder() / "run/series.csv").size(), 4u);
}

TEST(ProgramRun, EndsWithASummary) {
  const Scratch scratch;
  const Ended ended = testing::incognita(room_for("2", "run"), scratch.folder());
  for (const char* line : {"run          done\n", "frames       60 in 2.0 s: ", "path         ",
                           "trajectory   ATE ", "map          ", "consistency  consistent: NEES ",
                           "decisions    2\n", "speed        ", "results      run\n"})
    EXPECT_SAYS(ended.out, line);
  EXPECT_LE(std::count(ended.out.begin(), ended.out.end(), '\n'), 13)
      << "a line each, and one on the innovations";
  EXPECT_SAYS(ended.err, "scale: fixed by 4 anchors");
  EXPECT_SILENT_ON(ended.err, "results");
  const nlohmann::json said = testing::summary_of(scratch.folder() / "run")["consistency"];
  EXPECT_EQ(said["verdict"], "consistent");
  EXPECT_LE(said["frames_with_truth"], 60);
}

TEST(ProgramRun, ALostRunEndsWithASummaryToo) {
  const Scratch scratch;
  const Ended ended =
      testing::incognita(room_for("5", "run", {"--set", "room.cover_lens_from_s=2"}), scratch.folder());
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.out, "run          failed, lost at the end: ");
  EXPECT_SAYS(ended.out, "frames       150 in 5.0 s: ");
  EXPECT_SILENT_ON(ended.out, " 0 lost");
}

TEST(ProgramRun, UsesNoMetersWhereTheScaleIsUnobservable) {
  const Scratch scratch;
  const Ended ended = testing::incognita(
      {"run", "room", "--duration", "2", "--out", "run", "--set", "start.from=free"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, " after sim3 alignment");
  const std::string map = testing::contents(scratch.folder() / "run/figures/map.svg");
  EXPECT_SAYS(map, "x, arbitrary units (scale unobservable)");
  EXPECT_SILENT_ON(map, "x, m<");
  EXPECT_SAYS(testing::contents(scratch.folder() / "run/figures/errors.svg"), "arbitrary");
}

TEST(ProgramRun, ReportsAMissingGnuplot) {
  const Scratch scratch;
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", scratch.folder().c_str(), 1);
  const Ended ended =
      testing::incognita({"run", "room", "--duration", "0.5", "--out", "run"}, scratch.folder());
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "gnuplot is not installed");
  EXPECT_SAYS(ended.err, "apt-get install gnuplot-nox");
  EXPECT_FALSE(exists(scratch.folder() / "run/figures/map.svg"));
  EXPECT_TRUE(exists(scratch.folder() / "run/figures/map.gp"));
}

TEST(ProgramRun, OnlyOneRunWritesToAFolder) {
  const Scratch scratch;
  const auto run = scratch.folder() / "same";
  Program first(room_for("3600", "same"), Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(run / "series.csv", 20));
  const std::set<std::string> files = testing::everything_in(run);
  const std::string settings = testing::contents(run / "effective.toml");
  const Ended second = testing::incognita(room_for("0.2", "same", {"--seed", "9"}), scratch.folder());
  EXPECT_EQ(second.code, 2);
  EXPECT_SAYS(second.err, "--out same: another command is running in it");
  EXPECT_SAYS(second.err, "choose another folder with --out");
  EXPECT_EQ(second.out, "");
  EXPECT_EQ(testing::everything_in(run), files);
  EXPECT_EQ(testing::contents(run / "effective.toml"), settings);
  const Ended campaign = testing::incognita(
      {"campaign", "room", "--seeds", "1", "--duration", "0.1", "--out", "same"}, scratch.folder());
  EXPECT_EQ(campaign.code, 2);
  EXPECT_SAYS(campaign.err, "--out same: another command is running in it");
  const Ended claims = testing::incognita({"reproduce", "6.1", "--out", "same"}, scratch.folder());
  EXPECT_EQ(claims.code, 2);
  EXPECT_SAYS(claims.err, "--out same: another command is running in it");
  EXPECT_EQ(testing::everything_in(run), files);

  first.signal(SIGKILL);
  EXPECT_EQ(first.wait().signal, SIGKILL);
  EXPECT_TRUE(exists(run / ".lock")) << "left by the killed run";
  const Ended next = testing::incognita(room_for("0.2", "same", {"--seed", "9"}), scratch.folder());
  EXPECT_EQ(next.code, 0) << next.err;
  EXPECT_EQ(testing::lines(run / "series.csv").size(), 7u);
  EXPECT_FALSE(exists(run / ".lock"));
}

}  // namespace
}  // namespace incognita
