// `incognita run --resume`: what it writes, what it refuses, and that neither a kill nor a signal costs the saved run.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "incognita/record/files/state_file.hpp"
#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Circumstances;
using testing::Ended;
using testing::Program;
using testing::Scratch;
using testing::Words;

Words circle_into(const std::string& out, const std::string& seconds, const Words& more = {}) {
  Words words = {"run", "circle", "--duration", seconds, "--out", out, "--no-figures"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// False after ten seconds.
bool appears(const std::filesystem::path& file) {
  for (int i = 0; i < 500; ++i) {
    if (std::filesystem::exists(file)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::vector<std::string> rows_from(const std::filesystem::path& table, std::size_t first) {
  std::vector<std::string> rows = testing::lines(table);
  rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(std::min(first, rows.size())));
  return rows;
}

TEST(ProgramResume, ALongerDurationExtendsARun) {
  const Scratch scratch;
  ASSERT_EQ(testing::incognita(circle_into("whole", "4"), scratch.folder()).code, 0);
  ASSERT_EQ(testing::incognita(circle_into("first", "2"), scratch.folder()).code, 0);
  const Ended ended = testing::incognita(
      {"run", "--resume", "first/run.state", "--duration", "4", "--no-figures"}, scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto second = scratch / "out/circle-resumed";
  const std::size_t done = testing::lines(scratch / "first/series.csv").size();
  ASSERT_GT(done, 5u);
  for (const char* table : {"series.csv", "estimate.tum", "truth.tum", "covariance.csv"})
    EXPECT_TRUE(rows_from(second / table, 1) == rows_from(scratch / "whole" / table, done)) << table;
  EXPECT_EQ(testing::contents(second / "map.csv"), testing::contents(scratch / "whole/map.csv"));
  EXPECT_NEAR(testing::summary_of(second)["resumed_at_s"].get<double>(), 2, 0.2);
  testing::expect_whole_tables(second);
}

TEST(ProgramResume, AKilledRunGoesOnFromItsLastSave) {
  const Scratch scratch;
  const Words words = circle_into("killed", "100000", {"--set", "run.save_every_s=0.5"});
  for (int kill = 0; kill < 3; ++kill) {
    Program program(words, Circumstances{scratch.folder()});
    ASSERT_TRUE(appears(scratch / "killed/run.state"));
    ::usleep(static_cast<useconds_t>(30'000 * (kill + 1)));
    program.signal(SIGKILL);
    EXPECT_EQ(program.wait().signal, SIGKILL);
    std::filesystem::remove_all(scratch / "resumed");
    Program resumed({"run", "--resume", "killed/run.state", "--out", "resumed", "--no-figures"},
                    Circumstances{scratch.folder()});
    ASSERT_TRUE(testing::has_lines(scratch / "resumed/series.csv", 20));
    resumed.signal(SIGINT);
    EXPECT_EQ(resumed.wait().code, 1);
    // It begins one frame after the save: before the end of what the killed run wrote, or right after it
    const std::string first = testing::lines(scratch / "resumed/series.csv").at(1);
    const std::vector<std::string> before = testing::lines(scratch / "killed/series.csv");
    const auto same = std::find(before.begin(), before.end(), first);
    if (same == before.end()) continue;  // the rows of the last second were not written yet
    const std::vector<std::string> after = rows_from(scratch / "resumed/series.csv", 1);
    for (std::size_t i = 0; same + static_cast<std::ptrdiff_t>(i) != before.end() && i < after.size(); ++i)
      ASSERT_EQ(same[static_cast<std::ptrdiff_t>(i)], after[i]) << i;
  }
}

TEST(ProgramResume, ASignalSavesAtOnce) {
  const Scratch scratch;
  Program program(circle_into("run", "100000"), Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(scratch / "run/series.csv", 20));
  EXPECT_FALSE(std::filesystem::exists(scratch / "run/run.state"));
  program.signal(SIGUSR1);
  ASSERT_TRUE(appears(scratch / "run/run.state"));
  EXPECT_GT(read_state_file(scratch / "run/run.state").sections.size(), 5u);
  program.signal(SIGINT);
  const Ended ended = program.wait();
  EXPECT_SAYS(ended.err, "saved at t = ");
  EXPECT_EQ(ended.code, 1);
}

TEST(ProgramResume, RefusesWhatCannotBeResumed) {
  const Scratch scratch;
  ASSERT_EQ(testing::incognita(circle_into("run", "1"), scratch.folder()).code, 0);
  scratch.write("other.state", "[run]\nseed = 1\n");
  const std::string bytes = testing::contents(scratch / "run/run.state");
  scratch.write("short.state", bytes.substr(0, bytes.size() / 2));
  struct Refusal {
    Words words;
    std::string says;
  };
  for (const auto& [words, says] : std::vector<Refusal>{
           {{"--resume", "none.state"}, "none.state: cannot be read"},
           {{"--resume", "other.state"}, "other.state: is not a saved run; name a run.state"},
           {{"--resume", "short.state"}, "the file is damaged; resume from another file"},
           {{"--resume", "run/run.state"}, "its last frame; extend it with --duration"},
           {{"--resume", "run/run.state", "--duration", "2", "--out", "run"},
            "--out: run is the run that is resumed"},
           {{"--resume", "run/run.state", "--seed", "3"},
            "--seed: `run.seed` cannot change in the middle of a run"},
           {{"--resume", "run/run.state", "--set", "map.max_landmarks=3"},
            "`map.max_landmarks` cannot change"},
           {{"room", "--resume", "run/run.state"},
            "leave out `room`, or use the map alone, with --relocalize"},
           {{"room", "--resume", "run/run.state", "--relocalize"},
            "a saved map can be used with the same camera"},
           {{"--relocalize", "room"}, "--relocalize: only with --resume"},
           {{"--resume", "run/run.state", "--relocalize"}, "--relocalize: name the scenario"}}) {
    Words all = {"run"};
    all.insert(all.end(), words.begin(), words.end());
    const Ended ended = testing::incognita(all, scratch.folder());
    EXPECT_EQ(ended.code, 2) << says;
    EXPECT_SAYS(ended.err, says);
  }
  EXPECT_EQ(testing::contents(scratch / "run/run.state"), bytes);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace incognita
