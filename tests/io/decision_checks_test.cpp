// Inapplicable settings of the decision are refused, with the key and the reason.
#include <gtest/gtest.h>

#include <string>

#include "incognita/io/scenario/load_scenario.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

const std::string points =
    "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[vehicle]\n"
    "model = \"free-camera\"\n[controller]\nlaw = \"active\"\n";
const std::string room = "[start]\nfrom = \"free\"\n";

std::string refusal(const std::string& text) {
  const testing::Scratch scratch;
  const std::string file = scratch.write("mine.toml", text).string();
  return testing::message_of([&] { load_scenario(file); });
}

struct Case {
  std::string text, part;
};

TEST(DecisionChecks, RefuseInapplicableSettings) {
  const std::vector<Case> everywhere{
      {"[decision]\ndisplacements_m = [[0.3, 0, 0], [-0.3, 0, 0]]",
       "decision.displacements_m = [[0.3, 0.0, 0.0]"},
      {"[decision]\ndisplacements_m = [[0.3, 0, 0], [-0.3, 0, 0]]",
       "must have [0, 0, 0]: the action that is left"},
      {"[decision]\nhorizon = 0", "decision.horizon = 0: must be 1 to 20"},
      {"[decision]\nmax_evaluations = 0", "decision.max_evaluations"},
      {"[decision]\nhorizon = 2\nmetric = \"position-and-map\"", "must be 1 with decision.metric"},
      {"[decision]\nhorizon = 2\nschedule = \"one-per-frame\"", "must be 1 with decision.schedule"},
      {"[decision]\nstrategy = \"fixed-path\"", "decision.sequence"},
      {"[decision]\nstrategy = \"boldly\"", "decision.strategy"},
      {"[decision]\nstrategy = \"lawn-mower\"", "decision.min_bound_m"},
      {"[decision]\nstrategy = \"wall-follower\"", "with decision.strategy = `wall-follower`"},
      {"[decision]\nstrategy = \"wall-follower\"\nwall_distance_m = 2\nmin_bound_m = [-2, -3, 0]\n"
       "max_bound_m = [2, 3, 2]",
       "decision.wall_distance_m = 2.0: must be less than 2, half of the narrower side"},
      {"[decision]\nstrategy = \"frontier\"", "exploration.expected_landmarks = 0: must be more than 0"},
      {"[decision]\nstrategy = \"frontier\"\ngaze_rate_rad_s = 0\n[exploration]\nexpected_landmarks = 5",
       "decision.gaze_rate_rad_s = 0.0: must be more than 0 with decision.strategy = `frontier`"},
      {"[exploration]\nexpected_landmarks = -1", "exploration.expected_landmarks"},
      {"[exploration]\nexpected_landmarks = 5\nvolume_min_m = [1, 1, 1]\nvolume_max_m = [1, 2, 2]",
       "must be more than exploration.volume_min_m along each axis"},
      {"[exploration]\nexpected_landmarks = 5\ncell_m = 0.01", "at most a million cells"},
      {"[exploration]\nexpected_landmarks = 5\nvolume_max_m = [30, 3, 2.5]",
       "landmarks are not expected outside"},
  };
  for (const Case& one : everywhere) {
    EXPECT_HAS(refusal(points + one.text + "\n"), one.part);
    EXPECT_HAS(refusal(room + one.text + "\n"), one.part);
  }
  EXPECT_HAS(refusal(points + "[exploration]\ncounted = \"as-mapped\"\nexpected_landmarks = 5\n"),
             "`exploration.counted` belongs to `world.type = \"room\"");
}

/// In the point-landmark world the gaze is held by default, as the effective scenario shows.
TEST(DecisionChecks, TheGazeOfAnyFreeCameraMaySwing) {
  const std::string swing = points + "[decision]\ngaze = \"swing\"\n";
  EXPECT_EQ(refusal(swing), "(none)");
  EXPECT_EQ(refusal(room + "[decision]\ngaze = \"swing\"\n"), "(none)");
  const testing::Scratch scratch;
  EXPECT_HAS(effective_toml(load_scenario(scratch.write("points.toml", points).string())), "gaze = \"hold\"");
  EXPECT_HAS(effective_toml(load_scenario(scratch.write("room.toml", room).string())), "gaze = \"swing\"");
}

TEST(DecisionChecks, AnOperatorNeedsTheFrameOfTheRoom) {
  EXPECT_HAS(refusal(room + "[operator]\nholds = true\n"),
             "operator.holds = true: must be false with start.from");
}

TEST(DecisionChecks, AcceptTheRest) {
  EXPECT_EQ(refusal(room + "[decision]\ndisplacements_m = [[0.3, 0, 0], [0, 0, 0]]\n"), "(none)");
  EXPECT_EQ(refusal(points + "[decision]\nhorizon = 3\n"), "(none)");
}

}  // namespace
}  // namespace incognita
