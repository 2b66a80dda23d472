// The command `incognita adjust` on a run, and on what is none.
#include <gtest/gtest.h>

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

/// A camera with a target, 12 features and no adjustment of its own.
TEST(ProgramAdjust, MakesTheTrajectoryOfARunMoreAccurate) {
  const Scratch scratch;
  ASSERT_EQ(
      testing::incognita({"run", "room", "--seed", "2", "--duration", "10", "--out", "run", "--no-figures"},
                         scratch.folder())
          .code,
      0);
  const Ended ended = testing::incognita({"adjust", "run"}, scratch.folder());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "written: run/adjusted-whole.tum");
  EXPECT_LT(ate_m(scratch, "run/adjusted-whole.tum", "none"), ate_m(scratch, "run/estimate.tum", "none"));
  const Ended few =
      testing::incognita({"adjust", "run", "--views", "40", "--out", "few.tum"}, scratch.folder());
  ASSERT_EQ(few.code, 0) << few.err;
  EXPECT_SAYS(few.out, "40 views of ");
  EXPECT_EQ(testing::lines(scratch.folder() / "few.tum").size(),
            testing::lines(scratch.folder() / "run" / "estimate.tum").size())
      << "poses between the views are interpolated";
  EXPECT_LT(ate_m(scratch, "few.tum", "sim3"), 1.5 * ate_m(scratch, "run/estimate.tum", "sim3"));
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
       "measurements.csv:2: t, id, measured_1 and measured_2"},
      {header + "0,1,camera-2,3,landmark,12,14,matched\n",
       "measurements.csv:2: body 1, camera-2: only a run of one"},
      {header + "0,1,camera-1,3,landmark,12,14,matched\n",
       "0 frames with 4 matches or more: two are needed"}};
  for (const auto& [content, message] : wrong) {
    scratch.write("run/measurements.csv", content);
    const Ended ended = testing::incognita({"adjust", "run"}, scratch.folder());
    EXPECT_EQ(ended.code, 2);
    EXPECT_SAYS(ended.err, message);
  }
}

}  // namespace
}  // namespace incognita
