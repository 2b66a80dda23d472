// The program on teams of vehicles: the scenarios built in, what a run leaves, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

class BuiltInTeams : public ::testing::TestWithParam<const char*> {};

TEST_P(BuiltInTeams, RunsAndKnowsHowSureItIs) {
  const Scratch scratch;
  const Ended ended = testing::incognita(
      {"run", GetParam(), "--duration", "6", "--out", "run", "--no-figures"}, scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto summary = testing::summary_of(scratch.folder() / "run");
  testing::expect_whole_tables(scratch.folder() / "run");
  EXPECT_EQ(summary["ate_alignment"], "none");
  ASSERT_FALSE(summary["vehicles"].empty());
  for (const auto& vehicle : summary["vehicles"]) {
    EXPECT_LT(vehicle["mean_nees"].get<double>(), 6) << GetParam();
    EXPECT_LT(vehicle["ate_m"].get<double>(), 0.5) << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(All, BuiltInTeams,
                         ::testing::Values("lqg", "circle", "two-robots", "camera-circle", "dynamics",
                                           "localisation", "slam", "free-camera", "terrain"),
                         [](const auto& which) {
                           std::string name = which.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST(ProgramTeam, CountsRightMatchesWhereNothingHasAName) {
  const Scratch scratch;
  const Ended ended = testing::incognita({"run", "free-camera", "--duration", "3", "--set",
                                          "association.method=nearest", "--out", "run", "--no-figures"},
                                         scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "association.method = \"nearest\" (--set) replaces \"known\" (default)");
  const auto summary = testing::summary_of(scratch.folder() / "run");
  EXPECT_GT(summary["matches_right"].get<int>(), 100);
  EXPECT_LT(summary["matches_wrong"].get<int>(), summary["matches_right"].get<int>() / 20);
  EXPECT_TRUE(summary.contains("matches_missed"));
  EXPECT_TRUE(summary.contains("landmarks_born_again"));
}

TEST(ProgramTeam, LeavesEveryVehiclesPath) {
  const Scratch scratch;
  const std::filesystem::path run = scratch.folder() / "run";
  ASSERT_EQ(
      testing::incognita({"run", "two-robots", "--duration", "3", "--out", "run"}, scratch.folder()).code, 0);
  const std::string vehicles = bytes_of(run / "vehicles.csv");
  EXPECT_EQ(std::count(vehicles.begin(), vehicles.end(), '\n'), 1 + 2 * 30);
  EXPECT_SAYS(vehicles, "t,vehicle,x_m,y_m,z_m,heading_rad,two_sigma_x_m");
  EXPECT_SAYS(vehicles, "input_speed_m_s,input_turn_rate_rad_s");
  EXPECT_SAYS(bytes_of(run / "looks.csv"), ",vehicle,");
  for (const char* file : {"estimate-2.tum", "truth-2.tum", "covariance-2.csv"})
    EXPECT_TRUE(std::filesystem::exists(run / file)) << file;
  const Ended compared = testing::incognita(
      {"evaluate", "run/estimate-2.tum", "--truth", "run/truth-2.tum", "--align", "none"}, scratch.folder());
  EXPECT_EQ(compared.code, 0) << compared.err;
  // One vehicle in the same folder: the second's files go
  ASSERT_EQ(testing::incognita({"run", "circle", "--duration", "1", "--out", "run", "--no-figures"},
                               scratch.folder())
                .code,
            0);
  EXPECT_FALSE(std::filesystem::exists(run / "estimate-2.tum"));
}

TEST(ProgramTeam, GivesTheSameBytesForTheSameSeed) {
  const Scratch scratch;
  const auto go = [&](const char* seed, const char* out) {
    ASSERT_EQ(testing::incognita(
                  {"run", "two-robots", "--duration", "4", "--seed", seed, "--out", out, "--no-figures"},
                  scratch.folder())
                  .code,
              0);
  };
  go("3", "a"), go("3", "b"), go("4", "c");
  for (const char* file : {"vehicles.csv", "series.csv", "looks.csv", "map.csv", "run.mcap"}) {
    EXPECT_EQ(bytes_of(scratch.folder() / "a" / file), bytes_of(scratch.folder() / "b" / file)) << file;
    EXPECT_NE(bytes_of(scratch.folder() / "a" / file), bytes_of(scratch.folder() / "c" / file)) << file;
  }
}

TEST(ProgramTeam, ChoosesItsMovesAndSaysWhy) {
  const Scratch scratch;
  std::ostringstream text;
  text << "[run]\nworld = \"points\"\nsensor = \"range-bearing\"\nrate_hz = 10\nduration_s = "
          "5\n[vehicle]\nmodel = "
          "\"differential-drive\"\nsensor_forward_m = 0.3\nsensor_left_m = 0\n[steer]\nlaw = \"active\"\n";
  scratch.write("active.toml", text.str());
  const Ended ended =
      testing::incognita({"run", "active.toml", "--out", "run", "--no-figures"}, scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(testing::summary_of(scratch.folder() / "run")["decisions"], 5);
  EXPECT_SAYS(bytes_of(scratch.folder() / "run/actions.csv"), "t,chosen,");
}

TEST(ProgramTeam, RefusesAndLeavesNothing) {
  const Scratch scratch;
  const auto refused = [&](const testing::Words& sets, const char* because) {
    testing::Words words{"run", "circle", "--out", "run"};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    const Ended ended = testing::incognita(words, scratch.folder());
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_SAYS(ended.err, because);
    EXPECT_FALSE(std::filesystem::exists(scratch.folder() / "run"));
  };
  refused({"vehicle.sensor_forward_m=0"}, "axle");
  refused({"steer.gain_per_s=[40]"}, "gain");
  refused({"steer.gain_per_s=[1,2,3]"}, "1 number or 2");
  refused({"team.positions_m=[[0, 0, 2]]"}, "a z of 0");
  refused({"path.radius_m=70"}, "m/s");
  refused({"run.sensor=stereo", "ranges.max_range_m=3"}, "means nothing with run.sensor");
}

TEST(ProgramTeam, ChecksAScenarioWithoutRunningIt) {
  const Scratch scratch;
  const Ended ended = testing::incognita({"config", "two-robots", "--check"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "vehicles: 2");
}

}  // namespace
}  // namespace incognita
