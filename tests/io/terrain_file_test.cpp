// Height maps from images: position and height of each pixel, and refusals.
#include "incognita/io/scenario/terrain_file.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/merged_toml.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

const std::string points =
    "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[vehicle]\n"
    "model = \"terrain\"\n";
const std::string image = "[terrain]\ntype = \"image\"\nfile = \"ground.png\"\nsize_m = 8\nheight_m = 2\n";

LoadedScenario load(const Scratch& scratch, const std::string& text) {
  return load_scenario(scratch.write("mine.toml", testing::merged_toml(text)).string());
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
  EXPECT_HAS(complaint(text, ""), "mine.toml:9: terrain.file = \"ground.png\": there is no such file");
  const std::string noise = complaint(text, "this is no image");
  EXPECT_HAS(noise, "mine.toml:9: terrain.file = \"ground.png\": ");
  EXPECT_HAS(noise, "ground.png: is not an image");
  EXPECT_HAS(noise, "take a gray image of 8 or 16 bits");
  EXPECT_HAS(complaint(text, "P5\n4 4\n255\n123"), "the file is truncated");
  EXPECT_HAS(complaint(text, "P2\n4 1\n255\n1 2 3 4\n"), "has 4 x 1 pixels, and a height map needs 2 x 2");
}

TEST(TerrainFile, RefusesAnImageThatDoesNotContainTheStart) {
  const std::string start = "[start]\npositions_m = [[0, 0, 0], [3, 2.5, 0]]\nheadings_rad = [0]\n";
  const std::string why = complaint(points + image + start, "", ground<std::uint8_t>(255, 51));
  EXPECT_HAS(why, "mine.toml:10: terrain.size_m = 8.0: the image reaches 8 m by 4 m about the origin");
  EXPECT_HAS(why,
             "starts at [3, 2.5]: make the image larger or terrain.size_m more; here start.positions_m = ");
}

TEST(TerrainFile, SettingsOfOtherTerrainsAreRefused) {
  EXPECT_HAS(complaint(points + "[terrain]\nfile = \"x.png\"\n", ""),
             "`terrain.file` belongs to `terrain.type = \"image\"`; here `terrain.type = \"waves\"`");
  EXPECT_HAS(complaint(points + image + "amplitude_m = 1\n", ""),
             "`terrain.amplitude_m` belongs to `terrain.type = \"waves\"`; here `terrain.type = \"image\"`");
  EXPECT_HAS(complaint(points + "[terrain]\ntype = \"image\"\n", ""),
             "default: terrain.file = \"\": must name a gray image");
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
    "[world]\ntype = \"room\"\n[vehicle]\nmodel = \"terrain\"\n[start]\nfrom = \"free\"\n";

TEST(RoomVehicleSettings, AreAccepted) {
  EXPECT_EQ(complaint(room, ""), "(none)");
  EXPECT_EQ(complaint(room + "[controller]\nlaw = \"tracking\"\n[path]\ntype = \"circle\"\n", ""), "(none)");
  const Scratch scratch;
  LoadedScenario mine = load(scratch, room + "[estimator]\nuse_odometry = true\n");
  const LoadedScenario again = load(scratch, effective_toml(mine));
  EXPECT_TRUE(again.scenario.slam.filter.odometry);
}

TEST(RoomVehicleSettings, InapplicableOrContradictoryOnesAreRefused) {
  struct Case {
    const char *text, *part;
  };
  const Case cases[] = {
      {"[decision]\nimpulse_s = 0.2",
       "section `decision` belongs to `controller.law = \"active\"`; here `controller.law = \"none\"`"},
      {"[controller]\nlaw = \"active\"\n[decision]\nstep_m = 0.2",
       "`decision.step_m` belongs to `vehicle.model = \"free-camera\"`; here `vehicle.model = \"terrain\"`"},
      {"[controller]\nlaw = \"active\"\n[decision]\naccelerations = [[1, 0]]",
       "decision.accelerations = [[1.0, 0.0]]: must have [0, 0]"},
      {"[controller]\nlaw = \"active\"\n[decision]\nmin_bound_m = [1, 1, 1]",
       "must, with decision.max_bound_m, contain start.positions_m"},
      {"[operator]\nholds = true", "section `operator` belongs to `vehicle.model = \"free-camera\"`"},
      {"[controller]\nswing_period_s = 5",
       "`controller.swing_period_s` belongs to `vehicle.model = \"free-camera\"`"},
      {"[room]\nstart_position_m = [0, 0, 1]",
       "`room.start_position_m` belongs to `vehicle.model = \"free-camera\"`"},
      {"[estimator]\nsigma_slip_m_s = 0.1",
       "`estimator.sigma_slip_m_s` belongs to `estimator.use_odometry = true`"},
      {"[points]\ncount = 3",
       "section `points` belongs to `world.type = \"points\"`; here `world.type = \"room\"`"},
      {"[path]\noffsets_m = [[0, 0, 0]]\n[controller]\nlaw = \"tracking\"",
       "`path.offsets_m` belongs to `world.type = \"points\"`"},
      {"[start]\npositions_m = [[0, 0, 0], [1, 0, 0]]", "start.positions_m"},
      {"[start]\npositions_m = [[2.95, 0, 0]]", "must be inside room.size_m [6, 6, 2.5]"},
      {"[start]\npositions_m = [[1, 0, 0.5]]", "must have a z of 0"},
      {"[controller]\nlaw = \"lqg\"",
       "controller.law = \"lqg\": must be `none`, `tracking`, `feedback-linearization` or `active`"},
      {"[controller]\navoidance_distance_m = 0.2",
       "controller.avoidance_distance_m = 0.2: must be 0 or at least"},
      {"[mount]\nup_m = 0", "mount.up_m = 0.0: must be more than 0"},
      {"[terrain]\ntype = \"image\"", "terrain.file"},
  };
  for (const Case& one : cases) EXPECT_HAS(complaint(room + one.text + "\n", ""), one.part);
  EXPECT_HAS(complaint("[start]\nfrom = \"free\"\n[estimator]\nuse_odometry = true\n", ""),
             "`estimator.use_odometry` belongs to `vehicle.model = \"terrain\"`");
  EXPECT_HAS(complaint("[start]\nfrom = \"free\"\n[decision]\nmin_bound_m = [5, 5, 5]\n", ""),
             "must, with decision.max_bound_m, contain room.start_position_m");
  EXPECT_HAS(complaint(points + "[controller]\navoidance_distance_m = 1\n", ""),
             "`controller.avoidance_distance_m` belongs to `world.type = \"room\"`");
}

}  // namespace
}  // namespace incognita
