// The program's two ends of the link to a robot, as a user starts them.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita::testing {
namespace {

TEST(ProgramRobot, CheckingItsScenarioConnectsToNobody) {
  const Scratch scratch;
  const Ended ended = incognita({"config", "robot", "--check"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out + ended.err, "expected to avoid obstacles by itself");
}

TEST(ProgramRobot, ARunWithoutARobotFailsAndSaysWhatToStart) {
  const Scratch scratch;
  const Ended ended = incognita({"run", "robot", "--set", "robot.address=ws://127.0.0.1:1", "--set",
                                 "robot.give_up_s=1", "--out", "out", "--no-figures"},
                                scratch.folder());
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_SAYS(ended.err, "no connection to ws://127.0.0.1:1");
  EXPECT_SAYS(ended.err, "start rosbridge, or `incognita robot`, there");
  EXPECT_EQ(summary_of(scratch / "out")["status"], "failed");
}

TEST(ProgramRobot, ARunThatWaitsForItsRobotCanBeInterrupted) {
  const Scratch scratch;
  Program run({"run", "robot", "--set", "robot.address=ws://127.0.0.1:1", "--out", "out", "--no-figures"},
              {.folder = scratch.folder()});
  ASSERT_TRUE(has_lines(scratch / "out" / "effective.toml", 10));
  run.signal(SIGINT);
  EXPECT_EQ(run.wait().code, 1);
  EXPECT_EQ(summary_of(scratch / "out")["status"], "interrupted");
}

TEST(ProgramRobot, SaysWhichAddressAndWhichScenarioAreWrong) {
  const Scratch scratch;
  const Ended address = incognita({"run", "robot", "--set", "robot.address=localhost"}, scratch.folder());
  EXPECT_EQ(address.code, 2);
  EXPECT_SAYS(address.err, "robot.address");
  EXPECT_SAYS(address.err, "must begin with ws://");
  const Ended late = incognita({"run", "robot", "--set", "robot.late_s=0.05"}, scratch.folder());
  EXPECT_EQ(late.code, 2);
  EXPECT_SAYS(late.err, "must be more than the time of a frame");
  const Ended scenario = incognita({"robot", "explore-room"}, scratch.folder());
  EXPECT_EQ(scenario.code, 2);
  EXPECT_SAYS(scenario.err, "vehicle.model");
  const Ended relay = incognita({"robot", "--relay", "wss://robot"}, scratch.folder());
  EXPECT_EQ(relay.code, 2);
  EXPECT_SAYS(relay.err, "ssh -L");
  EXPECT_TRUE(everything_in(scratch.folder()).empty());
}

TEST(ProgramRobot, RefusesToResumeWhereNoRobotWas) {
  const Scratch scratch;
  const Ended ended = incognita({"robot", "--resume", "--port", "0", "--duration", "0.1", "--out", "nowhere"},
                                scratch.folder());
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_SAYS(ended.err, "nowhere: --resume needs the robot.csv");
  EXPECT_TRUE(everything_in(scratch.folder()).empty());
}

TEST(ProgramRobot, ARelayRefusesTheOptionsOfASimulation) {
  const Scratch scratch;
  const std::vector<std::vector<std::string>> simulations{
      {"--seed", "1"}, {"--resume"}, {"--set", "run.seed=1"}, {"--out", "out"}, {"explore-terrain"}};
  for (const auto& options : simulations) {
    std::vector<std::string> words{"robot",      "--relay", "ws://127.0.0.1:1", "--port", "0",
                                   "--duration", "0.1"};
    words.insert(words.end(), options.begin(), options.end());
    const Ended ended = incognita(words, scratch.folder());
    EXPECT_EQ(ended.code, 2) << options.front();
    EXPECT_SAYS(ended.err, "--relay");
  }
}

TEST(ProgramRobot, ARelayThatEndsDoesNotSaySomebodyStoppedIt) {
  const Scratch scratch;
  const Ended ended = incognita({"robot", "--relay", "ws://127.0.0.1:1", "--port", "0", "--duration", "0.1"},
                                scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "ended\n");
  EXPECT_EQ(ended.err.find("by hand"), std::string::npos) << ended.err;
}

TEST(ProgramRobot, ACampaignDrivesNoRobot) {
  const Scratch scratch;
  const Ended ended = incognita({"campaign", "robot", "--seeds", "1..2", "--out", "out"}, scratch.folder());
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "cannot do so with a robot");
}

TEST(ProgramRobot, ASimulatedRobotEndsAfterItsDurationAndLeavesItsLog) {
  const Scratch scratch;
  const Ended ended = incognita(
      {"robot", "explore-terrain", "--port", "0", "--duration", "1", "--out", "log"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "the robot is at ws://127.0.0.1:");
  EXPECT_GT(lines(scratch / "log" / "robot.csv").size(), 50u);
  EXPECT_GT(positions(scratch / "log" / "truth.tum").size(), 5u);
}

TEST(ProgramRobot, ARobotForOtherMachinesNeedsAToken) {
  const Scratch scratch;
  const Ended ended =
      incognita({"robot", "--address", "0.0.0.0", "--port", "0", "--duration", "0.1"}, scratch.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "/?token=");
}

}  // namespace
}  // namespace incognita::testing
