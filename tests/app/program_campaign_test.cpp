// The command `incognita campaign` for a user, a batch system and after a power failure.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <random>
#include <sstream>
#include <thread>

#include "tests/app/program.hpp"
#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::Ended;
using testing::Json;
using testing::Program;
using testing::Scratch;
using testing::Words;

constexpr const char* tables[] = {"runs.csv", "table.csv", "campaign.json"};
constexpr const char* vary = "plant.sigma_speed_m_s=0.05,0.2";

/// A folder with a scenario whose runs take a few milliseconds.
class TimedPosition : public Scratch {
 public:
  TimedPosition() {
    write("small.toml",
          "[world]\ntype = \"points\"\n[sensor]\ntype = \"range-bearing\"\n[run]\n"
          "rate_hz = 10\nduration_s = 2\n[vehicle]\nmodel = \"differential-drive\"\n"
          "sensor_forward_m = 0.3\nsensor_left_m = 0\n");
  }

  Words words(const Words& more, const char* out = "c") const {
    Words all = {"campaign", "small.toml", "--out", out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Ended campaign(const Words& more, const char* out = "c") const {
    return testing::incognita(words(more, out), folder());
  }
  std::string read(const std::string& file, const char* out = "c") const {
    return contents(*this / out / file);
  }

  /// Files of runs, without those that identify their campaign.
  std::vector<fs::path> results(const char* out = "c") const {
    std::vector<fs::path> found;
    if (!fs::exists(*this / out)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(*this / out)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("seed-") && name.ends_with(".json")) found.push_back(entry.path());
    }
    return found;
  }
};

void expect_same_tables(const TimedPosition& place, const char* a, const char* b) {
  for (const char* table : tables) {
    EXPECT_NE(place.read(table, a), "") << table;
    EXPECT_EQ(place.read(table, a), place.read(table, b)) << table;
  }
}

Json schema() {
  return Json::parse(contents(fs::path(INCOGNITA_SOURCE_DIR) / "docs/schemas/campaign.schema.json"));
}

void wait_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

TEST(ProgramCampaign, HelpHasAnExample) {
  const Scratch scratch;
  const Ended help = testing::incognita({"campaign", "--help"}, scratch.folder());
  EXPECT_EQ(help.code, 0);
  EXPECT_SAYS(help.out, "incognita campaign room --seeds");
}

TEST(ProgramCampaign, MakesTheSameRunsAsTheCommandRun) {
  const TimedPosition place;
  const Ended ended = place.campaign({"--seeds", "3..5", "--vary", vary});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "ate_m");
  EXPECT_SAYS(ended.out, "plant.sigma_speed_m_s=0.2");
  const Json answer = Json::parse(place.read("campaign.json"));
  EXPECT_EQ(answer["seeds"], Json({3, 4, 5}));
  ASSERT_EQ(answer["variants"].size(), 2u);
  double mean = 0;
  for (const char* seed : {"3", "4", "5"}) {
    const Ended alone = testing::incognita({"run", "small.toml", "--seed", seed, "--set",
                                            "plant.sigma_speed_m_s=0.2", "--no-figures", "--out", "alone"},
                                           place.folder());
    ASSERT_EQ(alone.code, 0) << alone.err;
    mean += testing::summary_of(place / "alone")["ate_m"].get<double>() / 3;
  }
  const Json& ate = answer["variants"][1]["measures"]["ate_m"];
  EXPECT_EQ(ate["n"], 3);
  EXPECT_NEAR(ate["mean"].get<double>(), mean, 1e-12);
  EXPECT_EQ(ate["versus_baseline"]["pairs"], 3);
  EXPECT_EQ(testing::lines(place / "c/runs.csv").size(), 1u + 6u);
  EXPECT_EQ(place.results().size(), 6u);
}

TEST(ProgramCampaign, AnswerConformsToItsSchema) {
  const TimedPosition place;
  const Ended ended = place.campaign({"--seeds", "1..6", "--vary", vary, "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, place.read("campaign.json"));
  EXPECT_EQ(testing::problems(Json::parse(ended.out), schema()), "");
  const Ended again = place.campaign({"--seeds", "1..6", "--vary", vary, "--json", "--measure", "ate_m"});
  const Json answer = Json::parse(again.out);
  EXPECT_EQ(testing::problems(answer, schema()), "");
  for (const Json& variant : answer["variants"]) EXPECT_EQ(variant["measures"].size(), 1u);
}

TEST(ProgramCampaign, TableDoesNotDependOnTheDistributionOfRuns) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..7", "--vary", vary, "--vary", "points.count=8,16"};
  const auto with = [&](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(place.campaign(with(what, {"--jobs", "1"}), "one").code, 0);
  ASSERT_EQ(place.campaign(with(what, {"--jobs", "5"}), "five").code, 0);
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    const Ended ended = place.campaign(with(what, {"--shard", shard}), "shards");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, "");
  }
  const Ended early = place.campaign(with(what, {"--table"}), "shards");
  EXPECT_EQ(early.code, 0) << early.err;
  expect_same_tables(place, "one", "five");
  expect_same_tables(place, "one", "shards");
  EXPECT_EQ(place.results("one").size(), 28u);
}

TEST(ProgramCampaign, ReportsRunsMissingFromAnEarlyTable) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..4", "--vary", vary};
  ASSERT_EQ(place.campaign({"--seeds", "1..4", "--vary", vary, "--shard", "1/2"}).code, 0);
  const Ended table = place.campaign({"--seeds", "1..4", "--vary", vary, "--table", "--json"});
  EXPECT_EQ(table.code, 1);
  EXPECT_SAYS(table.err, "4 of 8 runs are missing");
  EXPECT_EQ(Json::parse(table.out)["variants"][1]["missing"], 4);
  EXPECT_EQ(place.campaign(what).code, 0);
}

/// Restarts it repeatedly, and kills it each time a little later, until it ends by itself.
int kill_until_done(const TimedPosition& place, const Words& what, bool with_children) {
  std::mt19937 random(7);
  for (int kills = 0;; ++kills) {
    Program program(place.words(what, "killed"), {place.folder()});
    wait_ms(static_cast<int>(random() % 60) + 130 + 10 * kills);
    if (with_children)
      program.signal_group(SIGKILL);
    else
      program.signal(SIGKILL);
    const Ended ended = program.wait();
    if (ended.signal == 0) {
      EXPECT_EQ(ended.code, 0) << ended.err;
      return kills;
    }
  }
}

class KilledAtAnyMoment : public ::testing::TestWithParam<bool> {};

TEST_P(KilledAtAnyMoment, GivesTheSameTable) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..40", "--vary", vary, "--jobs", "3"};
  ASSERT_EQ(place.campaign(what, "whole").code, 0);
  EXPECT_GE(kill_until_done(place, what, GetParam()), 2);
  expect_same_tables(place, "whole", "killed");
  EXPECT_EQ(place.results("killed").size(), 80u);
}

INSTANTIATE_TEST_SUITE_P(Campaign, KilledAtAnyMoment, ::testing::Bool());

TEST(ProgramCampaign, RepeatsNoCompletedRun) {
  const TimedPosition place;
  ASSERT_EQ(place.campaign({"--seeds", "1..4", "--vary", vary}).code, 0);
  std::vector<std::pair<fs::path, std::string>> before;
  for (const fs::path& file : place.results()) before.emplace_back(file, contents(file));
  const Ended more = place.campaign({"--seeds", "1..6", "--vary", vary});
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_SAYS(more.err, "8 made before, 4 to make");
  // a repeated run would have other `seconds`
  for (const auto& [file, text] : before) EXPECT_EQ(contents(file), text);
  ASSERT_EQ(place.campaign({"--seeds", "1..6", "--vary", vary}, "whole").code, 0);
  expect_same_tables(place, "whole", "c");
}

TEST(ProgramCampaign, RepairsBrokenFilesAndKeepsForeignOnes) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..3", "--vary", vary};
  ASSERT_EQ(place.campaign(what, "whole").code, 0);
  ASSERT_EQ(place.campaign(what).code, 0);
  const std::vector<fs::path> results = place.results();
  const std::string text = contents(results[0]);
  testing::write(results[0], text.substr(0, text.size() / 2));
  testing::write(results[1], "");
  testing::write(results[2], "[1, 2]");
  testing::write(results[3], contents(results[4].parent_path() / "settings.json"));
  const fs::path stranger = results[4].parent_path() / ".seed-9.json.part-Ab12Cd";
  testing::write(stranger, "{");
  fs::last_write_time(stranger, fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::create_directories(place / "c/runs/holiday pictures");
  testing::write(place / "c/runs/notes.txt", "mine");
  testing::write(place / "c/runs.csv", "old");
  const Ended ended = place.campaign(what);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "2 made before, 4 to make");
  expect_same_tables(place, "whole", "c");
  EXPECT_FALSE(fs::exists(stranger));
  EXPECT_EQ(contents(place / "c/runs/notes.txt"), "mine");
}

TEST(ProgramCampaign, CountsFailedRuns) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..5", "--vary", "health.max_sigma_position_m=10,0.011"};
  const Ended ended = place.campaign(what);
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(place.read("campaign.json"));
  const Json& lost = answer["variants"][1];
  EXPECT_EQ(answer["variants"][0]["failed"], 0);
  EXPECT_EQ(lost["failed"], 5);
  EXPECT_EQ(lost["done"], 0);
  ASSERT_EQ(lost["failures"].size(), 5u);
  EXPECT_SAYS(lost["failures"][0]["reason"].get<std::string>(), "lost");
  EXPECT_EQ(lost["measures"]["failed"]["mean"], 1);
  EXPECT_EQ(lost["measures"]["failed"]["versus_baseline"]["difference"], 1);
  EXPECT_EQ(lost["measures"]["ate_m"]["n"], 0);
  EXPECT_EQ(lost["measures"]["ate_m"]["mean"], nullptr);
  EXPECT_EQ(lost["measures"]["ate_m"]["ended"], 5);
  EXPECT_EQ(lost["measures"]["ate_m"]["share_failed"], 1);
  EXPECT_EQ(lost["measures"]["ate_m"]["versus_baseline"]["pairs"], 0);
  EXPECT_EQ(lost["measures"]["ate_m"]["versus_baseline"]["pairs_left_out"], 5);
  EXPECT_SAYS(ended.out, "failed, and excluded above");
  EXPECT_SAYS(ended.out, "0 of 5   100 %");
  EXPECT_SAYS(ended.out, "--measure ate_m.below:0.1");
  EXPECT_SAYS(ended.err, "seed 3: failed: ");
  EXPECT_EQ(testing::lines(place / "c/runs.csv").size(), 1u + 10u);
  EXPECT_EQ(testing::problems(answer, schema()), "");
  const Ended again = place.campaign(what);
  EXPECT_SAYS(again.err, "10 made before, 0 to make");
  Words limited = what;
  limited.insert(limited.end(), {"--measure", "ate_m.below:1000", "--json"});
  const Json within = Json::parse(place.campaign(limited).out);
  EXPECT_EQ(testing::problems(within, schema()), "");
  EXPECT_EQ(within["variants"][0]["measures"]["ate_m.below:1000"]["mean"], 1);
  EXPECT_EQ(within["variants"][1]["measures"]["ate_m.below:1000"]["mean"], 0);
  EXPECT_EQ(within["variants"][1]["measures"]["ate_m.below:1000"]["versus_baseline"]["difference"], -1);
}

TEST(ProgramCampaign, RefusesAnInvalidLimitBeforeAnyRun) {
  const TimedPosition place;
  const Ended ended = place.campaign({"--seeds", "1..3", "--measure", "ate_m.below:low"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "--measure ate_m.below:low: a limit is a number");
  EXPECT_TRUE(place.results().empty());
  const Ended unknown = place.campaign({"--seeds", "1..3", "--jobs", "1", "--measure", "ate.below:1"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_SAYS(unknown.err, "--measure ate: no run has this measure; the nearest is ate_m");
}

std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> found;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::istringstream list(contents(task.path() / "children"));
    for (pid_t child = 0; list >> child;) found.push_back(child);
  }
  return found;
}

/// A process that makes a run of the only campaign started by this process.
pid_t process_of_a_run() {
  for (int i = 0; i < 1000; ++i, wait_ms(10)) {
    const std::vector<pid_t> ours = children_of(::getpid());
    if (ours.empty()) continue;
    const std::vector<pid_t> theirs = children_of(ours.front());
    if (!theirs.empty()) return theirs.front();
  }
  return 0;
}

TEST(ProgramCampaign, ACrashedRunIsAFailedRun) {
  const TimedPosition place;
  Program program(place.words({"--seeds", "1..3", "--duration", "20000", "--jobs", "1"}), {place.folder()});
  for (int i = 0; i < 3; ++i) {
    const pid_t run = process_of_a_run();
    ASSERT_NE(run, 0);
    wait_ms(50);  // its signal handlers are installed by then
    ASSERT_EQ(::kill(run, i == 1 ? SIGABRT : SIGSEGV), 0);
    wait_ms(200);
  }
  const Ended ended = program.wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(place.read("campaign.json"));
  EXPECT_EQ(answer["variants"][0]["failed"], 3);
  EXPECT_SAYS(answer["variants"][0]["failures"][1]["reason"].get<std::string>(), "crashed: signal 6");
  EXPECT_EQ(testing::problems(answer, schema()), "");
}

TEST(ProgramCampaign, AKilledRunIsRepeated) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..2", "--duration", "300", "--jobs", "1"};
  ASSERT_EQ(place.campaign(what, "whole").code, 0);
  Program program(place.words(what), {place.folder()});
  const pid_t run = process_of_a_run();
  ASSERT_NE(run, 0);
  ASSERT_EQ(::kill(run, SIGKILL), 0);
  const Ended ended = program.wait();
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_SAYS(ended.err, "killed from outside by signal 9");
  EXPECT_SAYS(ended.err, "1 runs are missing");
  EXPECT_EQ(place.campaign(what).code, 0);
  expect_same_tables(place, "whole", "c");
}

TEST(ProgramCampaign, InterruptedItEndsAndResumes) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..40", "--duration", "60", "--vary", vary, "--jobs", "2"};
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program(place.words(what), {place.folder()});
    ASSERT_NE(process_of_a_run(), 0);
    program.signal_group(signal);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_SAYS(ended.err, "interrupted: ");
    EXPECT_SAYS(ended.err, "the same command continues");
  }
  for (const std::string& name : testing::everything_in(place / "c")) EXPECT_SILENT_ON(name, ".part");
  EXPECT_EQ(place.campaign(what).code, 0);
  ASSERT_EQ(place.campaign(what, "whole").code, 0);
  expect_same_tables(place, "whole", "c");
}

TEST(ProgramCampaign, KeepsRunDirectoriesOnRequest) {
  const TimedPosition place;
  ASSERT_EQ(place.campaign({"--seeds", "1..2", "--keep-runs"}).code, 0);
  ASSERT_EQ(place.campaign({"--seeds", "1..2"}, "bare").code, 0);
  expect_same_tables(place, "bare", "c");
  int runs = 0;
  for (const fs::path& file : place.results()) {
    fs::path run = file;
    run.replace_extension();
    testing::expect_whole_tables(run);
    EXPECT_EQ(testing::summary_of(run)["status"], "done");
    EXPECT_TRUE(fs::exists(run / "run.mcap"));
    ++runs;
  }
  EXPECT_EQ(runs, 2);
  EXPECT_SAYS(place.campaign({"--seeds", "1..2", "--keep-runs"}, "bare").err,
              "2 runs were made before without it");
  EXPECT_SILENT_ON(*testing::everything_in(place / "bare").rbegin(), "run.mcap");
}

TEST(ProgramCampaign, AFullDiskIsReportedAndTheOtherRunsContinue) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..40"};
  ASSERT_EQ(place.campaign(what, "whole").code, 0);
  std::uintmax_t largest = 0;
  for (const fs::path& file : place.results("whole")) {
    largest = std::max({largest, fs::file_size(file), fs::file_size(file.parent_path() / "settings.json")});
  }
  const auto table = fs::file_size(place / "whole/runs.csv");
  // with the first limit the runs fit, but not their table; with the second not even the runs
  ASSERT_LT(largest, table);
  const Ended no_table = testing::incognita(
      place.words(what), {place.folder(), testing::Stream::kept, testing::Stream::kept, table - 1});
  EXPECT_EQ(no_table.code, 1);
  EXPECT_SAYS(no_table.err, "cannot write c/runs.csv: File too large");
  EXPECT_EQ(place.results().size(), 40u);
  EXPECT_EQ(place.campaign(what).code, 0);
  expect_same_tables(place, "whole", "c");
  const Ended no_room = testing::incognita(
      place.words(what, "d"), {place.folder(), testing::Stream::kept, testing::Stream::kept, 100});
  EXPECT_EQ(no_room.code, 2);
  EXPECT_SAYS(no_room.err, "settings.json: File too large");
  for (const std::string& name : testing::everything_in(place.folder())) EXPECT_SILENT_ON(name, ".part");
}

TEST(ProgramCampaign, ValuesMayBeLists) {
  const TimedPosition place;
  const Ended ended = place.campaign({"--seeds", "1", "--vary", "points.size_m=[20, 20, 0],[30,30,0]",
                                      "--baseline", "points.size_m=[30.0, 30.0, 0.0]"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(place.read("campaign.json"));
  ASSERT_EQ(answer["variants"].size(), 2u);
  EXPECT_EQ(answer["variants"][0]["varied"]["points.size_m"], "[20.0, 20.0, 0.0]");
  EXPECT_EQ(answer["baseline"], "points.size_m=[30.0, 30.0, 0.0]");
  EXPECT_TRUE(answer["variants"][0]["measures"]["ate_m"].contains("versus_baseline"));
  EXPECT_FALSE(answer["variants"][1]["measures"]["ate_m"].contains("versus_baseline"));
}

TEST(ProgramCampaign, RefusesInvalidArgumentsBeforeAnyRun) {
  const TimedPosition place;
  place.write("in-the-way", "a file\n");
  const std::size_t before = testing::everything_in(place.folder()).size();
  const std::pair<Words, std::string> wrong[] = {
      {{"--vary", "plant.sigma_sped_m_s=1"},
       "there is no setting `plant.sigma_sped_m_s`; the nearest is "
       "`plant.sigma_speed_m_s`"},
      {{"--vary", "plant.sigma_speed_m_s=-1,1"}, "--vary: plant.sigma_speed_m_s = -1"},
      {{"--vary", "plant.sigma_speed_m_s"}, "must be written section.name=value,value"},
      {{"--vary", "plant.sigma_speed_m_s="}, "a value is missing"},
      {{"--vary", "plant.sigma_speed_m_s=1,,2"}, "a value is missing"},
      {{"--vary", "points.size_m=[1,2"}, "do not close"},
      {{"--vary", "plant.sigma_speed_m_s=0.1,0.10"}, "occurs twice"},
      {{"--vary", "points.count=8", "--vary", "points.count=9"}, "given twice"},
      {{"--vary", "points.count=8", "--set", "points.count=9"}, "set the same"},
      {{"--vary", "run.duration_s=1,2", "--duration", "3"}, "set the same"},
      {{"--vary", "run.seed=1,2"}, "--seeds"},
      {{"--set", "run.seed=1"}, "--seeds"},
      {{"--vary", "decision.strategy=none,mutual-information"}, "belongs to `controller.law = \"active\"`"},
      {{"--seeds", "5..1"}, "is decreasing"},
      {{"--seeds", "1..3,2"}, "2 occurs twice"},
      {{"--seeds", ""}, "is not a seed"},
      {{"--seeds", "-1"}, "is not a seed"},
      {{"--seeds", "1..x"}, "`x` is not a seed"},
      {{"--seeds", "1..99999999999"}, "more than 1000000 runs"},
      {{"--seeds", "0..9223372036854775807"}, "more than 1000000 runs"},
      {{"--jobs", "0"}, "--jobs 0: must be a whole number from 1"},
      {{"--shard", "0/2"}, "must be written i/N"},
      {{"--shard", "3/2"}, "must be written i/N"},
      {{"--shard", "1"}, "must be written i/N"},
      {{"--table"}, "contains no campaign"},
      {{"--baseline", "points.count=8"}, "is not varied"},
      {{"--vary", "points.count=8,9", "--baseline", "points.count=7"}, "not one of the values"},
      {{"--out", ""}, "--out: is empty"},
      {{"--out", "in-the-way"}, "a file with this name exists"},
      {{"--out", "/proc/incognita"}, "--out /proc/incognita: cannot write"},
      {{"--sheds", "1"}, "the nearest is `--seeds`"}};
  for (const auto& [words, message] : wrong) {
    Words all = {"campaign", "small.toml"};
    all.insert(all.end(), words.begin(), words.end());
    const Ended ended = testing::incognita(all, place.folder());
    EXPECT_EQ(ended.code, 2) << message << ended.err;
    EXPECT_SAYS(ended.err, message);
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_EQ(testing::everything_in(place.folder()).size(), before);
}

TEST(ProgramCampaign, LeavesNothingIfNoRunCanStart) {
  const TimedPosition place;
  place.write("recorded.toml",
              "[world]\ntype = \"recording\"\n[recording]\nfolder = \"nowhere\"\n[start]\nfrom = \"free\"\n");
  const std::size_t before = testing::everything_in(place.folder()).size();
  const Ended ended =
      testing::incognita({"campaign", "recorded.toml", "--seeds", "1..3", "--out", "a/b"}, place.folder());
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_SAYS(ended.err, "nowhere");
  EXPECT_EQ(testing::everything_in(place.folder()).size(), before);
}

TEST(ProgramCampaign, WarnsIfSeedsHaveNoEffect) {
  const TimedPosition place;
  Words still = {"--seeds", "1..2", "--set", "points.file=points.csv"};
  for (const char* noise : {"plant.sigma_speed_m_s", "plant.sigma_turn_rate_rad_s", "plant.sigma_range_m",
                            "plant.sigma_bearing_rad", "start.sigma_position_m", "start.sigma_heading_rad"})
    still.insert(still.end(), {"--set", std::string(noise) + "=0"});
  place.write("points.csv", "id,x,y\n1,5,1\n2,6,-3\n");
  const Ended ended = place.campaign(still);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "small: every seed gave the same result");
  EXPECT_SILENT_ON(place.campaign({"--seeds", "1..2"}, "noisy").err, "every seed gave the same result");
}

TEST(ProgramCampaign, RefusesAnUnknownMeasureAfterTheFirstRun) {
  const TimedPosition place;
  const Ended ended = place.campaign({"--seeds", "1..200", "--jobs", "1", "--measure", "ate"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "--measure ate: no run has this measure; the nearest is ate_m. Completed runs");
  EXPECT_EQ(ended.out, "");
  ASSERT_EQ(place.results().size(), 1u);
  const fs::path kept = place.results()[0];
  const std::string made = contents(kept);
  const Ended again = place.campaign({"--seeds", "1..200", "--measure", "entropy.totl"});
  EXPECT_EQ(again.code, 2) << "from the results in the folder, before any run";
  EXPECT_SAYS(again.err, "the nearest is entropy.total");
  EXPECT_EQ(place.results().size(), 1u);
  const Ended right = place.campaign({"--seeds", "1..3", "--measure", "ate_m", "--measure", "failed"});
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_SAYS(right.err, "1 made before, 2 to make");
  EXPECT_EQ(contents(kept), made);
}

TEST(ProgramCampaign, AcceptsAMeasureOfTheLastVariantOnly) {
  const TimedPosition place;
  const Words what = {"--seeds", "1..3",   "--jobs",
                      "1",       "--vary", "start.positions_m=[[0, 0, 0]],[[0, 0, 0], [2, 0, 0]]"};
  Words right = what, wrong = what;
  right.insert(right.end(), {"--measure", "vehicles.2.ate_m"});
  wrong.insert(wrong.end(), {"--measure", "vehicles.3.ate_m"});
  const Ended refused = place.campaign(wrong, "wrong");
  EXPECT_EQ(refused.code, 2);
  EXPECT_SAYS(refused.err, "the nearest is vehicles.");
  EXPECT_EQ(place.results("wrong").size(), 2u) << "one of each variant";
  const Ended ended = place.campaign(right);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(place.results().size(), 6u);
}

TEST(ProgramCampaign, AFailedRunDoesNotDetermineTheMeasures) {
  const TimedPosition place;
  // every run of this campaign is lost
  const Ended ended = place.campaign(
      {"--seeds", "1..5", "--jobs", "1", "--measure", "ate", "--set", "health.max_sigma_position_m=0.011"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "--measure ate: ");
  EXPECT_EQ(place.results().size(), 5u) << "only after the last run";
}

/// A campaign that is running, and would take minutes.
std::unique_ptr<Program> running(const TimedPosition& place, Words more = {}) {
  more.insert(more.begin(), {"--seeds", "1..2", "--duration", "20000", "--jobs", "1"});
  auto program = std::make_unique<Program>(place.words(more), testing::Circumstances{place.folder()});
  EXPECT_NE(process_of_a_run(), 0);
  return program;
}

TEST(ProgramCampaign, OnlyOneCampaignRunsInAFolder) {
  const TimedPosition place;
  ASSERT_EQ(place.campaign({"--seeds", "1", "--duration", "20"}, "elsewhere").code, 0);
  auto first = running(place);
  const std::set<std::string> before = testing::everything_in(place / "c");
  const Words same = {"--seeds", "1..2", "--duration", "20000"};
  for (const Words& more : {Words{}, Words{"--shard", "1/2"}, Words{"--vary", vary}}) {
    Words words = same;
    words.insert(words.end(), more.begin(), more.end());
    const Ended second = place.campaign(words);
    EXPECT_EQ(second.code, 2);
    EXPECT_SAYS(second.err, "--out c: another command is running in it");
    EXPECT_EQ(second.out, "");
  }
  EXPECT_EQ(testing::everything_in(place / "c"), before);
  const Ended table = place.campaign({"--seeds", "1..2", "--duration", "20000", "--table"});
  EXPECT_EQ(table.code, 1) << "--table needs no lock";
  EXPECT_SAYS(table.err, "none of the 2 runs has been made yet");
  EXPECT_EQ(place.campaign({"--seeds", "1..2", "--duration", "20"}, "elsewhere").code, 0);

  first->signal(SIGKILL);
  EXPECT_EQ(first->wait().signal, SIGKILL);
  auto next = running(place);  // at once, with nothing to remove by hand
  next->signal(SIGTERM);
  EXPECT_EQ(next->wait().code, 1);
  EXPECT_FALSE(fs::exists(place / "c/.lock"));
}

TEST(ProgramCampaign, ShardsRunTogetherEachOnce) {
  const TimedPosition place;
  const auto first = running(place, {"--shard", "1/2"});
  const auto ended = [&](const Words& more) {
    Words words = {"--seeds", "1..2", "--duration", "20000"};
    words.insert(words.end(), more.begin(), more.end());
    return place.campaign(words);
  };
  const std::pair<Words, std::string> refused[] = {
      {{"--shard", "1/2"}, "another process with --shard 1/2 is running in it"},
      {{"--shard", "2/3"}, "another number of shards of this one, is running in it"},
      {{"--shard", "2/2", "--vary", vary}, "another campaign, or "},
      {{}, "--out c: another command is running in it"}};
  for (const auto& [words, message] : refused) {
    const Ended second = ended(words);
    EXPECT_EQ(second.code, 2);
    EXPECT_SAYS(second.err, message);
  }
  Program second(place.words({"--seeds", "1..2", "--duration", "20000", "--shard", "2/2"}), {place.folder()});
  wait_ms(1500);
  second.signal(SIGTERM);
  const Ended other = second.wait();
  EXPECT_EQ(other.code, 1) << other.err;
  EXPECT_SAYS(other.err, "interrupted: ");
  EXPECT_TRUE(fs::exists(place / "c/.lock")) << "the first still has it";
  EXPECT_EQ(ended({"--shard", "1/2"}).code, 2);
}

TEST(ProgramCampaign, RefusesTheFolderOfAnotherCampaign) {
  const TimedPosition place;
  ASSERT_EQ(place.campaign({"--seeds", "1..2", "--vary", vary}).code, 0);
  const std::string table = place.read("table.csv");
  const auto refused = [&](const Words& words, const std::string& because) {
    const Ended ended = place.campaign(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_SAYS(ended.err, because);
    EXPECT_SAYS(ended.err, "Choose another folder with --out");
  };
  refused({"--seeds", "1..2", "--vary", vary, "--duration", "3"}, "run.duration_s = 2.0 there, 3.0 here");
  refused({"--seeds", "1..2", "--set", "points.count=5"}, "points.count = 16 there, 5 here");
  fs::copy(place / "small.toml", place / "other.toml");
  const Ended other =
      testing::incognita({"campaign", "other.toml", "--out", "c", "--seeds", "1"}, place.folder());
  EXPECT_EQ(other.code, 2);
  EXPECT_SAYS(other.err, "scenario small there, other here");
  EXPECT_EQ(place.read("table.csv"), table);
  EXPECT_EQ(place.results().size(), 4u);
  // More values of the same setting extend the campaign
  const Ended more = place.campaign({"--seeds", "1..2", "--vary", "plant.sigma_speed_m_s=0.05,0.2,0.4"});
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_SAYS(more.err, "4 made before, 2 to make");
}

TEST(ProgramCampaign, RefusesTheSameFolderWithAnotherTerrain) {
  const TimedPosition place;
  place.write("hills.toml",
              "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nrate_hz = 10\n"
              "duration_s = 0.5\n[vehicle]\nmodel = \"terrain\"\n[terrain]\ntype = \"image\"\n"
              "file = \"hills.pgm\"\nsize_m = 30\nheight_m = 0.1\n");
  const auto over = [&](const std::string& heights) {
    place.write("hills.pgm", "P2\n4 4\n255\n" + heights);
    return testing::incognita({"campaign", "hills.toml", "--seeds", "1..2", "--out", "c"}, place.folder());
  };
  const std::string low = "0 9 0 9\n9 0 9 0\n0 9 0 9\n9 0 9 0\n",
                    high = "9 0 9 0\n9 0 9 0\n0 9 0 9\n9 0 9 0\n";
  ASSERT_EQ(over(low).code, 0);
  EXPECT_EQ(over(low).code, 0);
  const Ended other = over(high);
  EXPECT_EQ(other.code, 2) << other.err;
  EXPECT_SAYS(other.err, "terrain.file");
}

/// Runs `mpirun -n N incognita campaign` with these arguments; exit code and messages go to files.
int with_mpirun(const TimedPosition& place, const Words& words, int ranks) {
  std::string line =
      "cd '" + place.folder().string() +
      "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout -s KILL 100 mpirun "
      "--oversubscribe -n " +
      std::to_string(ranks) + " '" INCOGNITA_PROGRAM "'";
  for (const std::string& word : words) line += " '" + word + "'";
  return WEXITSTATUS(std::system((line + " > mpi.out 2> mpi.err").c_str()));
}

TEST(ProgramCampaign, MpiGivesTheSameTable) {
  if (std::system("mpirun --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "mpirun is not installed";
  const TimedPosition place;
  const Words what = {"--seeds", "1..20", "--vary", vary};
  ASSERT_EQ(place.campaign(what, "whole").code, 0);
  const int code = with_mpirun(place, place.words(what), 4);
  const std::string said = contents(place / "mpi.err");
  if (said.find("built without MPI") != std::string::npos) GTEST_SKIP() << said;
  EXPECT_EQ(code, 0) << said;
  EXPECT_SAYS(said, "40 runs: ");
  expect_same_tables(place, "whole", "c");
  EXPECT_EQ(with_mpirun(place, place.words({"--seeds", "3..1"}), 3), 2);
  EXPECT_SAYS(contents(place / "mpi.err"), "is decreasing");
}

}  // namespace
}  // namespace incognita
