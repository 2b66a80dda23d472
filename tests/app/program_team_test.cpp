// The program with teams of vehicles: built-in scenarios, output of a run, and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "incognita/record/files/tum.hpp"
#include "tests/app/generated_team.hpp"
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

TEST_P(BuiltInTeams, RunConsistently) {
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

TEST(ProgramTeam, CountsCorrectMatchesWithoutIdentities) {
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
  EXPECT_TRUE(summary.contains("duplicate_landmarks"));
}

TEST(ProgramTeam, WritesEveryVehiclesPath) {
  const Scratch scratch;
  const std::filesystem::path run = scratch.folder() / "run";
  ASSERT_EQ(
      testing::incognita({"run", "two-robots", "--duration", "3", "--out", "run"}, scratch.folder()).code, 0);
  const std::string vehicles = bytes_of(run / "vehicles.csv");
  EXPECT_EQ(std::count(vehicles.begin(), vehicles.end(), '\n'), 1 + 2 * 30);
  EXPECT_SAYS(vehicles, "t,vehicle,state,x_m,y_m,z_m,heading_rad,two_sigma_x_m");
  EXPECT_SAYS(vehicles, "input_speed_m_s,input_turn_rate_rad_s");
  EXPECT_SAYS(bytes_of(run / "measurements.csv"), ",2,sensor-1,1,body,") << "the second measures the first";
  for (const char* file : {"estimate-2.tum", "truth-2.tum", "covariance-2.csv"})
    EXPECT_TRUE(std::filesystem::exists(run / file)) << file;
  const Ended compared = testing::incognita(
      {"evaluate", "run/estimate-2.tum", "--truth", "run/truth-2.tum", "--align", "none"}, scratch.folder());
  EXPECT_EQ(compared.code, 0) << compared.err;
  // A later run with one vehicle in the same folder removes the second vehicle's files
  ASSERT_EQ(testing::incognita({"run", "circle", "--duration", "1", "--out", "run", "--no-figures"},
                               scratch.folder())
                .code,
            0);
  EXPECT_FALSE(std::filesystem::exists(run / "estimate-2.tum"));
}

TEST(ProgramTeam, IsDeterministicForASeed) {
  const Scratch scratch;
  const auto go = [&](const char* seed, const char* out) {
    ASSERT_EQ(testing::incognita(
                  {"run", "two-robots", "--duration", "4", "--seed", seed, "--out", out, "--no-figures"},
                  scratch.folder())
                  .code,
              0);
  };
  go("3", "a"), go("3", "b"), go("4", "c");
  for (const char* file : {"vehicles.csv", "series.csv", "measurements.csv", "map.csv", "run.mcap"}) {
    EXPECT_EQ(bytes_of(scratch.folder() / "a" / file), bytes_of(scratch.folder() / "b" / file)) << file;
    EXPECT_NE(bytes_of(scratch.folder() / "a" / file), bytes_of(scratch.folder() / "c" / file)) << file;
  }
}

/// A run of two robots whose truth has gaps: 16 of 21 ticks of robot 1 have a truth, 18 of robot 2.
class RecordedTeamWithGaps : public ::testing::Test {
 protected:
  RecordedTeamWithGaps() {
    team_.write(scratch_, "recording");
    scratch_.write(
        "s.toml",
        "[world]\ntype = \"recording\"\n[recording]\n"
        "folder = \"" +
            (scratch_.folder() / "recording").string() +
            "\"\nformat = \"mrclam\"\nteam = true\n\n[vehicle]\nmodel = \"differential-drive\"\n"
            "sigma_speed_m_s = 0.1\nsigma_turn_rate_rad_s = 0.1\n[sensor]\ntype = \"range-bearing\"\nsigma_range_m = 0.1\n"
            "sigma_bearing_rad = 0.05\n");
  }

  std::filesystem::path run() const { return scratch_.folder() / "run"; }

  /// Errors from the estimated poses and the true path of the robot, over the ticks at which its own truth is
  /// recorded.
  struct Worked {
    int ticks = 0;
    double rms_m = 0;
  };
  Worked errors_of(std::size_t robot) const {
    Worked out;
    const auto estimate = read_trajectory(run() / (robot == 0 ? "estimate.tum" : "estimate-2.tum"));
    for (const StampedPose& pose : estimate) {
      if (team_.without_truth[robot].has(pose.t)) continue;
      ++out.ticks;
      out.rms_m +=
          (pose.position - Eigen::Vector3d(team_.true_x_m(pose.t), team_.y_m(robot), 0)).squaredNorm();
    }
    out.rms_m = std::sqrt(out.rms_m / out.ticks);
    return out;
  }

  testing::GeneratedTeam team_;
  Scratch scratch_;
};

TEST_F(RecordedTeamWithGaps, ComparesEachRobotWithItsOwnTruth) {
  const Ended ended =
      testing::incognita({"run", "s.toml", "--out", "run", "--no-figures"}, scratch_.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto summary = testing::summary_of(run());
  EXPECT_EQ(summary["tracked_frames"], 21);
  const int ticks[] = {16, 18};
  ASSERT_EQ(summary["vehicles"].size(), 2u);
  for (std::size_t robot = 0; robot < 2; ++robot) {
    const Worked worked = errors_of(robot);
    EXPECT_EQ(worked.ticks, ticks[robot]);
    EXPECT_EQ(summary["vehicles"][robot]["compared_frames"], worked.ticks);
    EXPECT_NEAR(summary["vehicles"][robot]["ate_m"].get<double>(), worked.rms_m, 1e-9);
    EXPECT_TRUE(summary["vehicles"][robot]["mean_nees"].is_number());
  }
  EXPECT_EQ(summary["compared_poses"], ticks[0] + ticks[1]);
  EXPECT_SAYS(ended.out, "truth at 16 of 21 tracked frames");
  EXPECT_SAYS(ended.out, "truth at 18 of 21 tracked frames");
  testing::expect_whole_tables(run());
}

TEST_F(RecordedTeamWithGaps, EvaluateGivesTheSameErrors) {
  ASSERT_EQ(testing::incognita({"run", "s.toml", "--out", "run", "--no-figures"}, scratch_.folder()).code, 0);
  const Ended ended = testing::incognita({"evaluate", "run", "--json"}, scratch_.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto answer = nlohmann::json::parse(ended.out), summary = testing::summary_of(run());
  ASSERT_EQ(answer["vehicles"].size(), 2u);
  for (std::size_t robot = 0; robot < 2; ++robot) {
    const auto &one = answer["vehicles"][robot], &summarized = summary["vehicles"][robot];
    EXPECT_EQ(one["matched"], summarized["compared_frames"]);
    EXPECT_EQ(one["estimate_poses"], 21);
    EXPECT_NEAR(one["ate_m"]["rmse"].get<double>(), summarized["ate_m"].get<double>(), 1e-9);
    EXPECT_NEAR(one["mean_nees"].get<double>(), summarized["mean_nees"].get<double>(), 1e-6);
  }
  EXPECT_EQ(answer["matched"], summary["compared_poses"]);
  EXPECT_NEAR(answer["ate_m"]["rmse"].get<double>(), summary["ate_m"].get<double>(), 1e-9);
  EXPECT_NEAR(answer["mean_nees"].get<double>(), summary["mean_nees"].get<double>(), 1e-6);
  const std::string table = testing::incognita({"evaluate", "run"}, scratch_.folder()).out;
  EXPECT_SAYS(table, "vehicle 2: matched 18 of 21 estimated and 18 true poses");
  EXPECT_SAYS(table, "all vehicles: matched 34 of 42 estimated and 34 true poses; alignment none");
}

TEST_F(RecordedTeamWithGaps, EvaluateRefusesOneTruthForSeveralRobots) {
  ASSERT_EQ(testing::incognita({"run", "s.toml", "--out", "run", "--no-figures"}, scratch_.folder()).code, 0);
  const Ended ended = testing::incognita({"evaluate", "run", "--truth", "run/truth.tum"}, scratch_.folder());
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "is a run of 2 vehicles");
  EXPECT_SAYS(ended.err, "estimate-2.tum");
}

TEST(ProgramTeam, DecidesAndReportsItsScores) {
  const Scratch scratch;
  std::ostringstream text;
  text << "[world]\ntype = \"points\"\n[sensor]\ntype = \"range-bearing\"\n[run]\n"
          "rate_hz = 10\nduration_s = 5\n[vehicle]\nmodel = \"differential-drive\"\n"
          "sensor_forward_m = 0.3\nsensor_left_m = 0\n[controller]\nlaw = \"active\"\n";
  scratch.write("active.toml", text.str());
  const Ended ended =
      testing::incognita({"run", "active.toml", "--out", "run", "--no-figures"}, scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(testing::summary_of(scratch.folder() / "run")["decisions"], 5);
  EXPECT_SAYS(bytes_of(scratch.folder() / "run/actions.csv"), "t,chosen,");
  EXPECT_FALSE(std::filesystem::exists(scratch.folder() / "run/actions-2.csv"));
}

TEST(ProgramTeam, RecordsTheDecisionsOfEachVehicle) {
  const Scratch scratch;
  const Ended ended = testing::incognita({"run", "two-robots", "--duration", "3", "--set",
                                          "controller.law=active", "--out", "run", "--no-figures"},
                                         scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(testing::summary_of(scratch.folder() / "run")["decisions"], 6);
  for (const char* file : {"run/actions.csv", "run/actions-2.csv"}) {
    const std::string rows = bytes_of(scratch.folder() / file);
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 4) << file;
    EXPECT_EQ(rows.find("t,chosen,"), 0u) << rows;
  }
  const Ended again = testing::incognita({"run", "circle", "--duration", "1", "--out", "run", "--no-figures"},
                                         scratch.folder());
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(std::filesystem::exists(scratch.folder() / "run/actions-2.csv")) << "of the earlier run";
}

TEST(ProgramTeam, RefusesInvalidSettingsAndLeavesNothing) {
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
  refused({"controller.gain_per_s=[40]"}, "gain");
  refused({"controller.gain_per_s=[1,2,3]"}, "1 number or 2");
  refused({"start.positions_m=[[0, 0, 2]]"}, "a z of 0");
  refused({"path.radius_m=70"}, "m/s");
  refused({"sensor.type=stereo", "sensor.max_range_m=3"}, "`sensor.max_range_m` belongs to `sensor.type = ");
}

TEST(ProgramTeam, ChecksAScenarioWithoutRunningIt) {
  const Scratch scratch;
  const Ended ended = testing::incognita({"config", "two-robots", "--check"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "vehicles: 2");
}

}  // namespace
}  // namespace incognita
