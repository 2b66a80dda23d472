// The programs in examples/ run, print their results, and stay short.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> part;
  while (pipe && std::fgets(part.data(), part.size(), pipe.get())) text += part.data();
  return text;
}

double number_after(const std::string& text, const std::string& words) {
  const auto at = text.rfind(words);
  return at == std::string::npos ? -1 : std::stod(text.substr(at + words.size()));
}

TEST(Examples, OwnRangeBearingMapsItsPosts) {
  const std::string text = output_of(EXAMPLE_own_range_bearing);
  EXPECT_NE(text.find("6 posts mapped"), std::string::npos) << text;
  EXPECT_LT(number_after(text, "off by "), 0.5) << text;
  EXPECT_GE(number_after(text, "off by "), 0) << text;
}

TEST(Examples, TheFirstRobotAndAPostLocalizeTheSecond) {
  const std::string text = output_of(EXAMPLE_two_robots);
  EXPECT_LT(number_after(text, "sigma of the second robot "), 0.2) << text;
  EXPECT_GT(number_after(text, "sigma of the second robot "), 0) << text;
}

TEST(Examples, ActiveChoiceNamesAnActionEachPeriod) {
  const std::string text = output_of(EXAMPLE_active_choice);
  EXPECT_GE(std::count(text.begin(), text.end(), '\n'), 8) << text;
}

/// Images of the rendered room from a camera that slides to the left, as files.
TEST(Examples, OwnImagesAreTracked) {
  const LoadedScenario loaded = load_scenario("room");
  const auto room = std::make_shared<const Room>(loaded.scenario.room, 1);
  RoomCamera camera(room, make_camera(loaded.scenario.camera), loaded.scenario.room, 1);
  const testing::Scratch folder;
  std::string command = EXAMPLE_own_images;
  for (int k = 0; k < 30; ++k) {
    const auto image = camera.image_from({{1.6, 0.01 * k, 1.3}, level_gaze(0)}, {k, k / 30.0, 1 / 30.0});
    std::string file = "P5 320 240 255\n";
    file.append(reinterpret_cast<const char*>(image->row(0)), 320 * 240);
    command += " " + folder.write("image" + std::to_string(100 + k) + ".pgm", file).string();
  }
  const std::string text = output_of(command);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 31) << text;
  EXPECT_NE(text.rfind("tracking"), std::string::npos) << text;
  EXPECT_EQ(text.find("lost"), std::string::npos) << text;
}

TEST(Examples, TheReadmeShowsOne) {
  const auto text_of = [](const std::string& name) {
    std::ifstream file(std::string(INCOGNITA_SOURCE_DIR) + "/" + name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  };
  const std::string example = text_of("examples/two_robots.cpp");
  ASSERT_GT(example.size(), 500u);
  EXPECT_NE(text_of("README.md").find(example), std::string::npos);
}

TEST(Examples, AreShort) {
  for (const char* name : {"own_images", "own_range_bearing", "active_choice", "two_robots"}) {
    std::ifstream file(std::string(INCOGNITA_SOURCE_DIR) + "/examples/" + name + ".cpp");
    ASSERT_TRUE(file) << name;
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    EXPECT_LT(lines, 40) << name;
  }
}

}  // namespace
}  // namespace incognita
