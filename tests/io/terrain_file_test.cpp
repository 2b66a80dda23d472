// Height maps from images: position and height of each pixel, and refusals.
#include "incognita/io/scenario/terrain_file.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "incognita/io/scenario/settings.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

const std::string points = "[run]\nworld = \"points\"\nsensor = \"camera\"\n[vehicle]\nmodel = \"terrain\"\n";
const std::string image = "[terrain]\nkind = \"image\"\nfile = \"ground.png\"\nsize_m = 8\nheight_m = 2\n";

LoadedScenario load(const Scratch& scratch, const std::string& text) {
  return load_scenario(scratch.write("mine.toml", text).string());
}

/// 5 columns, 3 rows: white in the upper right corner, a given gray left of the middle.
template <class Pixel>
cv::Mat ground(Pixel white, Pixel gray) {
  cv::Mat map = cv::Mat_<Pixel>::zeros(3, 5);
  map.at<Pixel>(0, 4) = white;
  map.at<Pixel>(1, 1) = gray;
  return map;
}

void write_png(const Scratch& scratch, const cv::Mat& map) {
  ASSERT_TRUE(cv::imwrite((scratch / "ground.png").string(), map));
}

TEST(TerrainFile, RowsAreNorthToSouth) {
  const Scratch scratch;
  write_png(scratch, ground<std::uint8_t>(255, 51));
  const Terrain terrain = terrain_of(load(scratch, points + image));
  // 2 m apart, centered at the origin: x from -4 to 4, y from -2 to 2
  EXPECT_NEAR(terrain.at<double>(4, 2).height, 2, 1e-12);
  EXPECT_NEAR(terrain.at<double>(-2, 0).height, 0.4, 1e-12);
  EXPECT_NEAR(terrain.at<double>(4, -2).height, 0, 1e-12);
  EXPECT_NEAR(terrain.at<double>(0, 0).height, 0, 1e-12);
  EXPECT_TRUE(terrain.contains(3.99, 1.99));
  EXPECT_FALSE(terrain.contains(4.01, 0));
  EXPECT_FALSE(terrain.contains(0, 2.01));
}

TEST(TerrainFile, KeepsSixteenBits) {
  const Scratch scratch;
  write_png(scratch, ground<std::uint16_t>(65535, 1));
  const Terrain terrain = terrain_of(load(scratch, points + image));
  EXPECT_NEAR(terrain.at<double>(4, 2).height, 2, 1e-12);
  EXPECT_NEAR(terrain.at<double>(-2, 0).height, 2.0 / 65535, 1e-12);
}

TEST(TerrainFile, ReadsNetpbm) {
  const Scratch scratch;
  scratch.write("ground.png", "P2\n2 2\n255\n0 255\n51 0\n");
  const Terrain terrain = terrain_of(load(scratch, points + image));
  EXPECT_NEAR(terrain.at<double>(4, 4).height, 2, 1e-12);
  EXPECT_NEAR(terrain.at<double>(-4, -4).height, 0.4, 1e-12);
}

std::string complaint(const std::string& text, const std::string& bytes, const cv::Mat& map = {}) {
  const Scratch scratch;
  if (!bytes.empty()) scratch.write("ground.png", bytes);
  if (!map.empty()) write_png(scratch, map);
  return message_of([&] { terrain_of(load(scratch, text)); });
}

TEST(TerrainFile, RefusesFilesThatAreNotHeightMaps) {
  const std::string text = points + image;
  EXPECT_HAS(complaint(text, ""), "mine.toml:8: terrain.file = \"ground.png\": there is no such file");
  const std::string noise = complaint(text, "this is no image");
  EXPECT_HAS(noise, "mine.toml:8: terrain.file = \"ground.png\": ");
  EXPECT_HAS(noise, "ground.png: is not an image");
  EXPECT_HAS(noise, "take a grey image of 8 or 16 bits");
  EXPECT_HAS(complaint(text, "P5\n4 4\n255\n123"), "the file is truncated");
  EXPECT_HAS(complaint(text, "P2\n4 1\n255\n1 2 3 4\n"), "has 4 x 1 pixels, and a height map needs 2 x 2");
}

TEST(TerrainFile, RefusesAnImageThatDoesNotContainTheStart) {
  const std::string start = "[team]\npositions_m = [[0, 0, 0], [3, 2.5, 0]]\nheadings_rad = [0]\n";
  const std::string why = complaint(points + image + start, "", ground<std::uint8_t>(255, 51));
  EXPECT_HAS(why, "mine.toml:9: terrain.size_m = 8: the image reaches 8 m by 4 m about the origin");
  EXPECT_HAS(why, "starts at [3, 2.5] (team.positions_m): make the image larger or terrain.size_m more");
}

TEST(TerrainFile, SettingsOfOtherTerrainsAreRefused) {
  EXPECT_HAS(complaint(points + "[terrain]\nfile = \"x.png\"\n", ""),
             "terrain.file = \"x.png\": means nothing with terrain.kind = `waves`");
  EXPECT_HAS(complaint(points + image + "amplitude_m = 1\n", ""),
             "terrain.amplitude_m = 1.0: means nothing with terrain.kind = `image`");
  EXPECT_HAS(complaint(points + "[terrain]\nkind = \"image\"\n", ""),
             "default: terrain.file = \"\": must name a grey image");
}

TEST(TerrainFile, IsFoundByAnEffectiveScenarioElsewhere) {
  const Scratch scratch, elsewhere;
  write_png(scratch, ground<std::uint8_t>(255, 51));
  const LoadedScenario mine = load(scratch, points + image);
  const LoadedScenario again = load(elsewhere, effective_toml(mine));
  EXPECT_NEAR(terrain_of(again).at<double>(4, 2).height, 2, 1e-12);
}

// Settings of a vehicle in the rendered room, and inapplicable ones.
const std::string room =
    "[run]\nworld = \"room\"\n[vehicle]\nmodel = \"terrain\"\n[start]\nfrom = \"free\"\n";

TEST(RoomVehicleSettings, AreAccepted) {
  EXPECT_EQ(complaint(room, ""), "(none)");
  EXPECT_EQ(complaint(room + "[steer]\nlaw = \"tracking\"\n[path]\nkind = \"circle\"\n", ""), "(none)");
  const Scratch scratch;
  LoadedScenario mine = load(scratch, room + "[filter]\nodometry = true\n");
  const LoadedScenario again = load(scratch, effective_toml(mine));
  EXPECT_TRUE(again.scenario.slam.filter.odometry);
}

TEST(RoomVehicleSettings, InapplicableOrContradictoryOnesAreRefused) {
  struct Case {
    const char *text, *part;
  };
  const Case cases[] = {
      {"[decision]\nimpulse_s = 0.2", "decision.impulse_s = 0.2: means nothing with steer.law = `none`"},
      {"[steer]\nlaw = \"active\"\n[decision]\nstep_m = 0.2",
       "decision.step_m = 0.2: means nothing with vehicle.model = `terrain`"},
      {"[steer]\nlaw = \"active\"\n[decision]\naccelerations = [[1, 0]]",
       "decision.accelerations = [[1.0, 0.0]]: must have [0, 0]"},
      {"[steer]\nlaw = \"active\"\n[decision]\nmin_bound_m = [1, 1, 1]",
       "must, with decision.max_bound_m, leave team.positions_m inside"},
      {"[person]\nholds = true", "means nothing with vehicle.model = `terrain`"},
      {"[control]\ngaze_period_s = 5", "means nothing with vehicle.model = `terrain`"},
      {"[room]\nstart_position_m = [0, 0, 1]", "means nothing with vehicle.model = `terrain`"},
      {"[filter]\nsigma_slip_m_s = 0.1", "means nothing with filter.odometry = false"},
      {"[points]\ncount = 3", "means nothing with run.world = `room`"},
      {"[path]\noffsets_m = [[0, 0, 0]]\n[steer]\nlaw = \"tracking\"",
       "means nothing with run.world = `room`"},
      {"[team]\npositions_m = [[0, 0, 0], [1, 0, 0]]", "team.positions_m"},
      {"[team]\npositions_m = [[2.95, 0, 0]]", "must be inside room.size_m [6, 6, 2.5]"},
      {"[team]\npositions_m = [[1, 0, 0.5]]", "must have a z of 0"},
      {"[steer]\nlaw = \"lqg\"",
       "steer.law = \"lqg\": must be `active`, `none`, `tracking` or `feedback-linearisation`"},
      {"[steer]\nkeep_clear_m = 0.2", "steer.keep_clear_m = 0.2: must be 0 or at least"},
      {"[mount]\nup_m = 0", "mount.up_m = 0.0: must be more than 0"},
      {"[terrain]\nkind = \"image\"", "terrain.file"},
  };
  for (const Case& one : cases) EXPECT_HAS(complaint(room + one.text + "\n", ""), one.part);
  EXPECT_HAS(complaint("[start]\nfrom = \"free\"\n[filter]\nodometry = true\n", ""),
             "filter.odometry = true: means nothing with a camera that is on no vehicle");
  EXPECT_HAS(complaint("[start]\nfrom = \"free\"\n[decision]\nmin_bound_m = [5, 5, 5]\n", ""),
             "must, with decision.max_bound_m, leave room.start_position_m inside");
  EXPECT_HAS(complaint(points + "[steer]\nkeep_clear_m = 1\n", ""),
             "means nothing with run.world = `points`");
}

}  // namespace
}  // namespace incognita
