// The command `incognita campaign` after crashes, kills and full disks, and several of them in one folder.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <random>
#include <set>
#include <string>

#include "tests/app/campaign_folder.hpp"

namespace incognita {
namespace {

using namespace testing;

/// Restarts it repeatedly, and kills it each time a little later, until it ends by itself.
int kill_until_done(const CampaignFolder& campaigns, const Words& what, bool with_children) {
  std::mt19937 random(7);
  for (int kills = 0;; ++kills) {
    Program program(campaigns.words(what, "killed"), {campaigns.folder()});
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
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..40", "--vary", vary, "--jobs", "3"};
  ASSERT_EQ(campaigns.campaign(what, "whole").code, 0);
  EXPECT_GE(kill_until_done(campaigns, what, GetParam()), 2);
  expect_same_tables(campaigns, "whole", "killed");
  EXPECT_EQ(campaigns.results("killed").size(), 80u);
}

INSTANTIATE_TEST_SUITE_P(Campaign, KilledAtAnyMoment, ::testing::Bool());

TEST(ProgramCampaign, RepeatsNoCompletedRun) {
  const CampaignFolder campaigns;
  ASSERT_EQ(campaigns.campaign({"--seeds", "1..4", "--vary", vary}).code, 0);
  std::vector<std::pair<fs::path, std::string>> before;
  for (const fs::path& file : campaigns.results()) before.emplace_back(file, contents(file));
  const Ended more = campaigns.campaign({"--seeds", "1..6", "--vary", vary});
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_SAYS(more.err, "8 made before, 4 to make");
  // a repeated run would have other `seconds`
  for (const auto& [file, text] : before) EXPECT_EQ(contents(file), text);
  ASSERT_EQ(campaigns.campaign({"--seeds", "1..6", "--vary", vary}, "whole").code, 0);
  expect_same_tables(campaigns, "whole", "c");
}

TEST(ProgramCampaign, RepairsBrokenFilesAndKeepsForeignOnes) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..3", "--vary", vary};
  ASSERT_EQ(campaigns.campaign(what, "whole").code, 0);
  ASSERT_EQ(campaigns.campaign(what).code, 0);
  const std::vector<fs::path> results = campaigns.results();
  const std::string text = contents(results[0]);
  testing::write(results[0], text.substr(0, text.size() / 2));
  testing::write(results[1], "");
  testing::write(results[2], "[1, 2]");
  testing::write(results[3], contents(results[4].parent_path() / "settings.json"));
  const fs::path stranger = results[4].parent_path() / ".seed-9.json.part-Ab12Cd";
  testing::write(stranger, "{");
  fs::last_write_time(stranger, fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::create_directories(campaigns / "c/runs/holiday pictures");
  testing::write(campaigns / "c/runs/notes.txt", "mine");
  testing::write(campaigns / "c/runs.csv", "old");
  const Ended ended = campaigns.campaign(what);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "2 made before, 4 to make");
  expect_same_tables(campaigns, "whole", "c");
  EXPECT_FALSE(fs::exists(stranger));
  EXPECT_EQ(contents(campaigns / "c/runs/notes.txt"), "mine");
}

TEST(ProgramCampaign, ACrashedRunIsAFailedRun) {
  const CampaignFolder campaigns;
  Program program(campaigns.words({"--seeds", "1..3", "--duration", "20000", "--jobs", "1"}),
                  {campaigns.folder()});
  for (int i = 0; i < 3; ++i) {
    const pid_t run = process_of_a_run();
    ASSERT_NE(run, 0);
    wait_ms(50);  // its signal handlers are installed by then
    ASSERT_EQ(::kill(run, i == 1 ? SIGABRT : SIGSEGV), 0);
    wait_ms(200);
  }
  const Ended ended = program.wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(campaigns.read("campaign.json"));
  EXPECT_EQ(answer["variants"][0]["failed"], 3);
  EXPECT_SAYS(answer["variants"][0]["failures"][1]["reason"].get<std::string>(), "crashed: signal 6");
  EXPECT_EQ(testing::problems(answer, schema()), "");
}

TEST(ProgramCampaign, AKilledRunIsRepeated) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..2", "--duration", "300", "--jobs", "1"};
  ASSERT_EQ(campaigns.campaign(what, "whole").code, 0);
  Program program(campaigns.words(what), {campaigns.folder()});
  const pid_t run = process_of_a_run();
  ASSERT_NE(run, 0);
  ASSERT_EQ(::kill(run, SIGKILL), 0);
  const Ended ended = program.wait();
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_SAYS(ended.err, "killed from outside by signal 9");
  EXPECT_SAYS(ended.err, "1 runs are missing");
  EXPECT_EQ(campaigns.campaign(what).code, 0);
  expect_same_tables(campaigns, "whole", "c");
}

TEST(ProgramCampaign, InterruptedItEndsAndResumes) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..40", "--duration", "60", "--vary", vary, "--jobs", "2"};
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program(campaigns.words(what), {campaigns.folder()});
    ASSERT_NE(process_of_a_run(), 0);
    program.signal_group(signal);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_SAYS(ended.err, "interrupted: ");
    EXPECT_SAYS(ended.err, "the same command continues");
  }
  for (const std::string& name : testing::everything_in(campaigns / "c")) EXPECT_SILENT_ON(name, ".part");
  EXPECT_EQ(campaigns.campaign(what).code, 0);
  ASSERT_EQ(campaigns.campaign(what, "whole").code, 0);
  expect_same_tables(campaigns, "whole", "c");
}

TEST(ProgramCampaign, AFullDiskIsReportedAndTheOtherRunsContinue) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..40"};
  ASSERT_EQ(campaigns.campaign(what, "whole").code, 0);
  std::uintmax_t largest = 0;
  for (const fs::path& file : campaigns.results("whole")) {
    largest = std::max({largest, fs::file_size(file), fs::file_size(file.parent_path() / "settings.json")});
  }
  const auto table = fs::file_size(campaigns / "whole/runs.csv");
  // with the first limit the runs fit, but not their table; with the second not even the runs
  ASSERT_LT(largest, table);
  const Ended no_table = testing::incognita(
      campaigns.words(what), {campaigns.folder(), testing::Stream::kept, testing::Stream::kept, table - 1});
  EXPECT_EQ(no_table.code, 1);
  EXPECT_SAYS(no_table.err, "cannot write c/runs.csv: File too large");
  EXPECT_EQ(campaigns.results().size(), 40u);
  EXPECT_EQ(campaigns.campaign(what).code, 0);
  expect_same_tables(campaigns, "whole", "c");
  const Ended no_room = testing::incognita(
      campaigns.words(what, "d"), {campaigns.folder(), testing::Stream::kept, testing::Stream::kept, 100});
  EXPECT_EQ(no_room.code, 2);
  EXPECT_SAYS(no_room.err, "settings.json: File too large");
  for (const std::string& name : testing::everything_in(campaigns.folder())) EXPECT_SILENT_ON(name, ".part");
}

/// A campaign that is running, and would take minutes.
std::unique_ptr<Program> running(const CampaignFolder& campaigns, Words more = {}) {
  more.insert(more.begin(), {"--seeds", "1..2", "--duration", "20000", "--jobs", "1"});
  auto program = std::make_unique<Program>(campaigns.words(more), testing::Circumstances{campaigns.folder()});
  EXPECT_NE(process_of_a_run(), 0);
  return program;
}

TEST(ProgramCampaign, OnlyOneCampaignRunsInAFolder) {
  const CampaignFolder campaigns;
  ASSERT_EQ(campaigns.campaign({"--seeds", "1", "--duration", "20"}, "elsewhere").code, 0);
  auto first = running(campaigns);
  const std::set<std::string> before = testing::everything_in(campaigns / "c");
  const Words same = {"--seeds", "1..2", "--duration", "20000"};
  for (const Words& more : {Words{}, Words{"--shard", "1/2"}, Words{"--vary", vary}}) {
    Words words = same;
    words.insert(words.end(), more.begin(), more.end());
    const Ended second = campaigns.campaign(words);
    EXPECT_EQ(second.code, 2);
    EXPECT_SAYS(second.err, "--out c: another command is running in it");
    EXPECT_EQ(second.out, "");
  }
  EXPECT_EQ(testing::everything_in(campaigns / "c"), before);
  const Ended table = campaigns.campaign({"--seeds", "1..2", "--duration", "20000", "--table"});
  EXPECT_EQ(table.code, 1) << "--table needs no lock";
  EXPECT_SAYS(table.err, "none of the 2 runs has been made yet");
  EXPECT_EQ(campaigns.campaign({"--seeds", "1..2", "--duration", "20"}, "elsewhere").code, 0);

  first->signal(SIGKILL);
  EXPECT_EQ(first->wait().signal, SIGKILL);
  auto next = running(campaigns);  // at once, with nothing to remove by hand
  next->signal(SIGTERM);
  EXPECT_EQ(next->wait().code, 1);
  EXPECT_FALSE(fs::exists(campaigns / "c/.lock"));
}

TEST(ProgramCampaign, ShardsRunTogetherEachOnce) {
  const CampaignFolder campaigns;
  const auto first = running(campaigns, {"--shard", "1/2"});
  const auto ended = [&](const Words& more) {
    Words words = {"--seeds", "1..2", "--duration", "20000"};
    words.insert(words.end(), more.begin(), more.end());
    return campaigns.campaign(words);
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
  Program second(campaigns.words({"--seeds", "1..2", "--duration", "20000", "--shard", "2/2"}),
                 {campaigns.folder()});
  wait_ms(1500);
  second.signal(SIGTERM);
  const Ended other = second.wait();
  EXPECT_EQ(other.code, 1) << other.err;
  EXPECT_SAYS(other.err, "interrupted: ");
  EXPECT_TRUE(fs::exists(campaigns / "c/.lock")) << "the first still has it";
  EXPECT_EQ(ended({"--shard", "1/2"}).code, 2);
}

TEST(ProgramCampaign, RefusesTheFolderOfAnotherCampaign) {
  const CampaignFolder campaigns;
  ASSERT_EQ(campaigns.campaign({"--seeds", "1..2", "--vary", vary}).code, 0);
  const std::string table = campaigns.read("table.csv");
  const auto refused = [&](const Words& words, const std::string& because) {
    const Ended ended = campaigns.campaign(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_SAYS(ended.err, because);
    EXPECT_SAYS(ended.err, "Choose another folder with --out");
  };
  refused({"--seeds", "1..2", "--vary", vary, "--duration", "3"}, "run.duration_s = 2.0 there, 3.0 here");
  refused({"--seeds", "1..2", "--set", "points.count=5"}, "points.count = 16 there, 5 here");
  fs::copy(campaigns / "small.toml", campaigns / "other.toml");
  const Ended other =
      testing::incognita({"campaign", "other.toml", "--out", "c", "--seeds", "1"}, campaigns.folder());
  EXPECT_EQ(other.code, 2);
  EXPECT_SAYS(other.err, "scenario small there, other here");
  EXPECT_EQ(campaigns.read("table.csv"), table);
  EXPECT_EQ(campaigns.results().size(), 4u);
  // More values of the same setting extend the campaign
  const Ended more = campaigns.campaign({"--seeds", "1..2", "--vary", "plant.sigma_speed_m_s=0.05,0.2,0.4"});
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_SAYS(more.err, "4 made before, 2 to make");
}

TEST(ProgramCampaign, RefusesTheSameFolderWithAnotherTerrain) {
  const CampaignFolder campaigns;
  campaigns.write("hills.toml",
                  "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nrate_hz = 10\n"
                  "duration_s = 0.5\n[vehicle]\nmodel = \"terrain\"\n[terrain]\ntype = \"image\"\n"
                  "file = \"hills.pgm\"\nsize_m = 30\nheight_m = 0.1\n");
  const auto over = [&](const std::string& heights) {
    campaigns.write("hills.pgm", "P2\n4 4\n255\n" + heights);
    return testing::incognita({"campaign", "hills.toml", "--seeds", "1..2", "--out", "c"},
                              campaigns.folder());
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
int with_mpirun(const CampaignFolder& campaigns, const Words& words, int ranks) {
  std::string line =
      "cd '" + campaigns.folder().string() +
      "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout -s KILL 100 mpirun "
      "--oversubscribe -n " +
      std::to_string(ranks) + " '" INCOGNITA_PROGRAM "'";
  for (const std::string& word : words) line += " '" + word + "'";
  return WEXITSTATUS(std::system((line + " > mpi.out 2> mpi.err").c_str()));
}

TEST(ProgramCampaign, MpiGivesTheSameTable) {
  if (std::system("mpirun --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "mpirun is not installed";
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..20", "--vary", vary};
  ASSERT_EQ(campaigns.campaign(what, "whole").code, 0);
  const int code = with_mpirun(campaigns, campaigns.words(what), 4);
  const std::string said = contents(campaigns / "mpi.err");
  if (said.find("built without MPI") != std::string::npos) GTEST_SKIP() << said;
  EXPECT_EQ(code, 0) << said;
  EXPECT_SAYS(said, "40 runs: ");
  expect_same_tables(campaigns, "whole", "c");
  EXPECT_EQ(with_mpirun(campaigns, campaigns.words({"--seeds", "3..1"}), 3), 2);
  EXPECT_SAYS(contents(campaigns / "mpi.err"), "is decreasing");
}

}  // namespace
}  // namespace incognita
