// The command `incognita adjust` on a run, and on what is none.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;
using testing::Words;

double ate_m(const Scratch& scratch, const std::string& estimate, const std::string& align) {
  const Ended ended = testing::incognita(
      {"evaluate", estimate, "--truth", "run/truth.tum", "--align", align, "--json"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  return nlohmann::json::parse(ended.out)["ate_m"]["rmse"].get<double>();
}

/// A camera with a target, 12 features and no adjustment of its own. Compared by shape: the adjustment takes the errors of the
/// target's corners, which last and displace the whole path, for white noise.
TEST(ProgramAdjust, MakesTheTrajectoryOfARunMoreAccurate) {
  const Scratch scratch;
  ASSERT_EQ(
      testing::incognita({"run", "room", "--seed", "3", "--duration", "10", "--out", "run", "--no-figures"},
                         scratch.folder())
          .code,
      0);
  const Ended ended = testing::incognita({"adjust", "run"}, scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "written: run/adjusted-whole.tum");
  EXPECT_LT(ate_m(scratch, "run/adjusted-whole.tum", "sim3"), ate_m(scratch, "run/estimate.tum", "sim3"));
  const Ended few =
      testing::incognita({"adjust", "run", "--views", "40", "--out", "few.tum"}, scratch.folder());
  ASSERT_EQ(few.code, 0) << few.err;
  EXPECT_SAYS(few.out, "40 views of ");
  const std::vector<Eigen::Vector3d> before = testing::positions(scratch.folder() / "run" / "estimate.tum"),
                                     after = testing::positions(scratch.folder() / "few.tum");
  ASSERT_EQ(before.size(), after.size());
  double farthest_m = 0;
  for (std::size_t i = 1; i < 40; ++i) {
    const std::size_t frames = before.size() - 2;  // after the start, in which nothing is searched for
    const std::size_t a = 1 + (i - 1) * frames / 39, b = 1 + i * frames / 39;
    for (std::size_t k = a; k < b; ++k) {
      const double share = static_cast<double>(k - a) / static_cast<double>(b - a);
      const Eigen::Vector3d moved =
          before[k] + (1 - share) * (after[a] - before[a]) + share * (after[b] - before[b]);
      EXPECT_LT((after[k] - moved).norm(), 1e-6) << k;
      farthest_m = std::max(farthest_m, (after[k] - before[k]).norm());
    }
  }
  EXPECT_LT((after[0] - before[0] - (after[1] - before[1])).norm(), 1e-6) << "as the first view";
  EXPECT_GT(farthest_m, 1e-4);
}

TEST(ProgramAdjust, RefusesWhatIsNoRunOfOneCamera) {
  const Scratch scratch;
  EXPECT_SAYS(testing::incognita({"adjust", "nowhere"}, scratch.folder()).err,
              "nowhere: is no run directory: it has no measurements.csv");
  ASSERT_EQ(testing::incognita({"run", "two-robots", "--duration", "2", "--out", "team", "--no-figures"},
                               scratch.folder())
                .code,
            0);
  const Ended team = testing::incognita({"adjust", "team"}, scratch.folder());
  EXPECT_EQ(team.code, 2);
  EXPECT_SAYS(team.err, "team: is the run of a team");
  const std::pair<std::string, std::string> others[] = {
      {"circle", "sensor-1: only a run of one camera can be adjusted"},
      {"rendered-terrain", "on no vehicle, can be adjusted"}};
  for (const auto& [scenario, message] : others) {
    ASSERT_EQ(testing::incognita({"run", scenario, "--duration", "2", "--out", scenario, "--no-figures"},
                                 scratch.folder())
                  .code,
              0);
    const Ended ended = testing::incognita({"adjust", scenario}, scratch.folder());
    EXPECT_EQ(ended.code, 2);
    EXPECT_SAYS(ended.err, message);
  }
}

TEST(ProgramAdjust, NamesTheRowThatIsDamaged) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch.folder() / "run");
  scratch.write("run/estimate.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  scratch.write("run/map.csv", "id,kind,x,y,z\n");
  const std::string header = "t,body,sensor,id,kind,measured_1,measured_2,outcome\n";
  const std::pair<std::string, std::string> wrong[] = {
      {"t,body,sensor\n", "measurements.csv:1: there is no column `outcome`"},
      {header + "0,1,camera-1,3,landmark,12,nan,matched\n",
       "measurements.csv:2: t, measured_1 and measured_2"},
      {header + "0,1,camera-1,1e30,landmark,12,14,matched\n", "and its id an integer"},
      {header + "0,1,camera-2,3,landmark,12,14,matched\n",
       "measurements.csv:2: body 1, camera-2: only a run of one"},
      {header + "0,1,camera-1,3,landmark,12,14,matched\n", "0 frames with 4 matches or more"}};
  for (const auto& [content, message] : wrong) {
    scratch.write("run/measurements.csv", content);
    const Ended ended = testing::incognita({"adjust", "run"}, scratch.folder());
    EXPECT_EQ(ended.code, 2);
    EXPECT_SAYS(ended.err, message);
  }
}

TEST(ProgramAdjust, SaysWhatIsMissingAndSavesWhatIsThere) {
  const Scratch scratch;
  ASSERT_EQ(
      testing::incognita({"run", "room", "--duration", "3", "--out", "run", "--no-figures"}, scratch.folder())
          .code,
      0);
  const auto refused = [&](const Words& more) {
    Words words{"adjust", "run"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = testing::incognita(words, scratch.folder());
    EXPECT_EQ(ended.code, 2);
    return ended.err;
  };
  EXPECT_SAYS(refused({"--out", "run/truth.tum"}), "run/truth.tum: is a file of the run");
  EXPECT_SAYS(refused({"--out", "nowhere/path.tum"}), "nowhere: is no folder");
  const std::filesystem::path run = scratch.folder() / "run";
  std::filesystem::rename(run / "map.csv", run / "map");
  EXPECT_SAYS(refused({}), "map.csv: does not exist, and has the positions of the anchors");
  scratch.write("run/map.csv", "id,kind,x,y,z\n0,anchor,nan,0,0\n");
  EXPECT_SAYS(refused({}), "map.csv:2: x, y and z of an anchor must be finite");
  scratch.write("run/map.csv", "id,kind,x,y,z\n");
  EXPECT_SAYS(refused({}), "map.csv: has no anchor ");
  std::filesystem::rename(run / "map", run / "map.csv");
  const Ended gaps = testing::incognita({"adjust", "run", "--views", "3"}, scratch.folder());
  EXPECT_SAYS(gaps.err, "successive views share ");
  std::filesystem::remove(run / "effective.toml");
  EXPECT_SAYS(refused({}), "effective.toml: does not exist, and has the camera");
}

}  // namespace
}  // namespace incognita
