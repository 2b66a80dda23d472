// What a person does to a run takes effect at its tick, is logged, and repeats the same bytes.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <fstream>
#include <sstream>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;
using testing::Words;

/// A run of `scenario` into out/ with these rows of interventions.jsonl.
Ended disturbed(const Scratch& scratch, const std::string& scenario, const std::string& rows,
                const Words& more = {}) {
  std::filesystem::create_directory(scratch.folder() / "log");
  std::ofstream(scratch.folder() / "log/interventions.jsonl") << rows;
  Words words = {"run", scenario, "--out", "out", "--no-figures", "--replay-commands", "log"};
  words.insert(words.end(), more.begin(), more.end());
  return testing::incognita(words, scratch.folder());
}

std::string row(int frame, const std::string& intervention) {
  return "{\"frame\":" + std::to_string(frame) + ",\"t\":0,\"intervention\":" + intervention + "}\n";
}

TEST(ProgramInterventions, ADisplacedCameraIsLost) {
  const Scratch scratch;
  const Ended ended =
      disturbed(scratch, "room", row(45, R"({"type":"displace","body":1,"by_m":[-0.8,0.5,0],"turn_rad":1})"),
                {"--duration", "3"});
  EXPECT_EQ(ended.code, 1) << ended.err;
  const nlohmann::json summary = testing::summary_of(scratch.folder() / "out");
  EXPECT_GT(summary["lost_frames"], 10);
  EXPECT_NE(ended.err.find("lost"), std::string::npos);
}

TEST(ProgramInterventions, ACoveredLensIsLostAndSaysSo) {
  const Scratch scratch;
  const Ended ended =
      disturbed(scratch, "room", row(30, R"({"type":"cover-lens","covered":true})"), {"--duration", "2"});
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_GE(testing::summary_of(scratch.folder() / "out")["lost_frames"], 10);
}

TEST(ProgramInterventions, ADrivenCameraGoesLeft) {
  const Scratch scratch;
  const Ended ended =
      disturbed(scratch, "room",
                row(30, R"({"type":"take-over","body":1})") +
                    row(30, R"({"type":"drive","body":1,"forward":0,"left":1,"up":0,"turn":0})"),
                {"--duration", "3"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto truth = testing::positions(scratch.folder() / "out/truth.tum");
  ASSERT_EQ(truth.size(), 90u);
  EXPECT_GT(truth.back().y() - truth[30].y(), 0.5);  // it looks along x
  EXPECT_LT(std::abs(truth.back().x() - truth[30].x()), 0.2);
}

TEST(ProgramInterventions, AVehicleOnAPathIsDrivenAndGivenBack) {
  const Scratch scratch;
  const Ended ended =
      disturbed(scratch, "circle",
                row(20, R"({"type":"take-over","body":1})") + row(60, R"({"type":"give-back","body":1})"),
                {"--duration", "12"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto truth = testing::positions(scratch.folder() / "out/truth.tum");
  ASSERT_GT(truth.size(), 100u);
  EXPECT_LT((truth[58] - truth[25]).norm(), 0.05) << "taken over and not driven: it stands";
  EXPECT_GT((truth[100] - truth[60]).norm(), 0.5);
}

TEST(ProgramInterventions, RepeatTheSameBytes) {
  const Scratch scratch;
  const std::string rows = row(10, R"({"type":"image-noise","sigma_gray":5})") +
                           row(20, R"({"type":"push","body":1,"velocity_m_s":[0,0.2,0],"duration_s":0.2})") +
                           row(25, R"({"type":"light","factor":0.8})") +
                           row(30, R"({"type":"set","settings":["decision.strategy=random"]})") +
                           row(40, R"({"type":"take-over","body":1})") +
                           row(60, R"({"type":"give-back","body":1})");
  EXPECT_EQ(disturbed(scratch, "room", rows, {"--duration", "3"}).code, 0);
  EXPECT_EQ(testing::incognita({"run", "room", "--duration", "3", "--out", "again", "--no-figures",
                                "--replay-commands", "out"},
                               scratch.folder())
                .code,
            0);
  const auto one = scratch.folder() / "out", two = scratch.folder() / "again";
  for (const char* file : {"effective.toml", "estimate.tum", "truth.tum", "series.csv", "measurements.csv",
                           "actions.csv", "map.csv", "interventions.jsonl", "run.mcap"})
    EXPECT_TRUE(testing::contents(one / file) == testing::contents(two / file)) << file;
  EXPECT_EQ(testing::incognita({"run", "room", "--duration", "3", "--out", "plain", "--no-figures"},
                               scratch.folder())
                .code,
            0);
  EXPECT_FALSE(testing::contents(one / "truth.tum") ==
               testing::contents(scratch.folder() / "plain/truth.tum"));
}

TEST(ProgramInterventions, TheScenarioIsThatOfTheRun) {
  const Scratch scratch;
  EXPECT_EQ(
      testing::incognita({"run", "room", "--duration", "1", "--seed", "5", "--out", "one", "--no-figures"},
                         scratch.folder())
          .code,
      0);
  EXPECT_EQ(testing::incognita({"run", "--out", "two", "--no-figures", "--replay-commands", "one"},
                               scratch.folder())
                .code,
            0);
  for (const char* file : {"effective.toml", "estimate.tum", "run.mcap"})
    EXPECT_TRUE(testing::contents(scratch.folder() / "one" / file) ==
                testing::contents(scratch.folder() / "two" / file))
        << file;
}

TEST(ProgramInterventions, TheRunThatIsRepeatedIsNeverOverwritten) {
  const Scratch scratch;
  const Ended first =
      disturbed(scratch, "room", row(3, R"({"type":"light","factor":0.8})"), {"--duration", "1"});
  ASSERT_EQ(first.code, 0) << first.err;
  std::filesystem::create_directory(scratch.folder() / "elsewhere");
  std::filesystem::rename(scratch.folder() / "out", scratch.folder() / "elsewhere/out");
  std::filesystem::create_directory(scratch.folder() / "out");
  std::filesystem::rename(scratch.folder() / "elsewhere/out", scratch.folder() / "out/room");
  const auto log = testing::contents(scratch.folder() / "out/room/interventions.jsonl");

  const Ended again =
      testing::incognita({"run", "--no-figures", "--replay-commands", "out/room"}, scratch.folder());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(testing::contents(scratch.folder() / "out/room-again/interventions.jsonl"), log);
  const Ended onto = testing::incognita(
      {"run", "--no-figures", "--replay-commands", "out/room", "--out", "out/../out/room"}, scratch.folder());
  EXPECT_EQ(onto.code, 2);
  EXPECT_NE(onto.err.find("another folder"), std::string::npos) << onto.err;
  EXPECT_EQ(testing::contents(scratch.folder() / "out/room/interventions.jsonl"), log);
}

TEST(ProgramInterventions, ALineThatWasCutOffIsLeftOut) {
  const Scratch scratch;
  const std::string whole = row(3, R"({"type":"light","factor":0.8})");
  const Ended ended =
      disturbed(scratch, "room", whole + whole.substr(0, whole.size() / 2), {"--duration", "1"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  std::istringstream log(testing::contents(scratch.folder() / "out/interventions.jsonl"));
  int rows = 0;
  for (std::string line; std::getline(log, line);) ++rows;
  EXPECT_EQ(rows, 1);
}

TEST(ProgramInterventions, CommandsAfterTheEndAreNamed) {
  const Scratch scratch;
  const Ended ended =
      disturbed(scratch, "room", row(9999, R"({"type":"light","factor":0.8})"), {"--duration", "1"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find("before the frames of the last 1 commands"), std::string::npos) << ended.err;
}

TEST(ProgramInterventions, AreRefusedWithFileAndLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"nonsense\n", "interventions.jsonl:1"},
      {row(3, R"({"type":"light","factor":1})") + row(2, R"({"type":"light","factor":1})"),
       "interventions.jsonl:2"},
      {row(3, R"({"type":"light","factor":99})"), "factor"},
      {row(-1, R"({"type":"light","factor":1})"), "negative"},
      {"{\"frame\":1}\n", "intervention"}};
  for (const auto& [rows, message] : cases) {
    const Scratch scratch;
    const Ended ended = disturbed(scratch, "room", rows, {"--duration", "1"});
    EXPECT_EQ(ended.code, 2) << rows;
    EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(scratch.folder() / "out")) << rows;
  }
}

/// A run that cannot take an intervention ends, and says which.
TEST(ProgramInterventions, ImpossibleOnesEndTheRun) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"({"type":"push","body":2,"velocity_m_s":[0,0,0],"duration_s":1})", "body 2 does not exist"},
      {R"({"type":"drive","body":1,"forward":1,"left":0,"up":0,"turn":0})", "not taken over"},
      {R"({"type":"set","settings":["run.seed=3"]})", "run.seed"},
      {R"({"type":"set","settings":["decision.strategy=best"]})", "decision.strategy"},
      {R"({"type":"set","settings":["decision.displacements_m=[[0,0,0],[1,0,0]]"]})", "actions"}};
  for (const auto& [intervention, message] : cases) {
    const Scratch scratch;
    const Ended ended = disturbed(scratch, "room", row(5, intervention), {"--duration", "1"});
    EXPECT_EQ(ended.code, 1) << intervention;
    EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
  }
  const Scratch scratch;
  const Ended ended =
      disturbed(scratch, "circle", row(5, R"({"type":"light","factor":2})"), {"--duration", "1"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("no images"), std::string::npos) << ended.err;
}

TEST(ProgramInterventions, NeedARunDirectory) {
  const Scratch scratch;
  const Ended ended = testing::incognita({"run", "--replay-commands", "nowhere"}, scratch.folder());
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("nowhere"), std::string::npos);
}

}  // namespace
}  // namespace incognita
