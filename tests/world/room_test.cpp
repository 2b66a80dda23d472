#include "incognita/world/rendered/room.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace incognita;

namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The three numbers of each line that begins with `key`.
std::vector<Eigen::Vector3d> vectors_of(const std::string& text, const std::string& key) {
  std::vector<Eigen::Vector3d> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    double x, y, z;
    if (std::sscanf(line.c_str(), (key + " = [%lf, %lf, %lf]").c_str(), &x, &y, &z) == 3)
      out.emplace_back(x, y, z);
  }
  return out;
}

const std::string targets = std::string(INCOGNITA_SOURCE_DIR) + "/scenarios/targets/";

TEST(RoomLayout, TheTargetFileHasThePoseOfTheSheet) {
  const Sheet sheet = room_layout(RoomSettings{}, 1).sheet;
  const std::string file = text_of(targets + "sheet.toml");
  const auto corners = vectors_of(file, "position_m");
  ASSERT_EQ(corners.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR((corners[i] - sheet.corners()[i]).norm(), 0, 1e-12) << i;
  ASSERT_EQ(vectors_of(file, "normal").size(), 1u);
  EXPECT_EQ(vectors_of(file, "normal")[0], sheet.normal());
}

/// The black quadrant of each patch is towards the center of the rectangle, as seen from the front.
TEST(RoomLayout, TheTargetPatchesShowTheirCorners) {
  const int black_u[] = {12, 2, 2, 12}, black_v[] = {12, 12, 2, 2};
  for (int corner = 0; corner < 4; ++corner) {
    const std::string pgm = text_of(targets + "sheet_corner" + std::to_string(corner) + ".pgm");
    const std::string head = "P5\n15 15\n255\n";
    ASSERT_EQ(pgm.size(), head.size() + 15 * 15);
    ASSERT_EQ(pgm.substr(0, head.size()), head);
    const auto gray = [&](int u, int v) { return static_cast<unsigned char>(pgm[head.size() + 15 * v + u]); };
    for (const int u : {2, 12})
      for (const int v : {2, 12}) {
        const bool black = u == black_u[corner] && v == black_v[corner];
        EXPECT_EQ(gray(u, v), black ? 14 : 236) << corner << " " << u << " " << v;
      }
  }
}

TEST(RoomLayout, BoxesStandAtWallsApartFromEachOtherAndClearOfThePath) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RoomSettings s;
    const RoomLayout layout = room_layout(s, seed);
    ASSERT_EQ(layout.boxes.size(), 6u);
    for (const Box& box : layout.boxes) {
      const Eigen::Array3d low = box.min - layout.inside.min, high = layout.inside.max - box.max;
      EXPECT_EQ(low.z(), 0);
      EXPECT_NEAR(std::min({low.x(), low.y(), high.x(), high.y()}), 0, 1e-12) << "touches a wall";
      EXPECT_GE(std::min(low.minCoeff(), high.minCoeff()), -1e-12) << "is in the room";
      for (double along = 0; along <= 1;
           along += 0.1) {  // the path from the start to the target, with clearance
        const Eigen::Vector3d p =
            s.start_position_m + along * (Eigen::Vector3d(3, 0, 1.3) - s.start_position_m);
        EXPECT_FALSE(box.grown(0.5).contains({p.x(), p.y(), 0.2}));
      }
      EXPECT_FALSE(box.grown(1.0).contains({0, 0, 0.2})) << "the center is free";
    }
  }
}

TEST(RoomLayout, DependsOnTheSeedAlone) {
  const auto first_box = [](std::uint64_t seed) { return room_layout(RoomSettings{}, seed).boxes[0].min; };
  EXPECT_EQ(first_box(4), first_box(4));
  EXPECT_NE(first_box(4), first_box(5));
}

TEST(RoomLayout, RefusesInvalidRooms) {
  RoomSettings s;
  s.boxes = 25;
  EXPECT_THROW(room_layout(s, 1), std::invalid_argument);
  s.boxes = 24;
  s.size_m = {2, 2, 2.5};
  EXPECT_THROW(room_layout(s, 1), std::invalid_argument) << "24 boxes do not fit, and the search ends";
  s.boxes = 0;
  s.size_m.x() = NAN;
  EXPECT_THROW(room_layout(s, 1), std::invalid_argument);
}

TEST(Texture, MagnificationIsBilinearAndDistanceGivesTheMean) {
  Image checks(64, 48);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) checks(u, v) = (u + v) % 2 ? 200 : 40;
  const Texture texture(checks);
  const auto at = [](double texels) { return static_cast<int>(texels * 256); };
  EXPECT_EQ(texture.sample(at(10), at(10), 0.5f), 40 * 256);
  EXPECT_EQ(texture.sample(at(11), at(10), 0.5f), 200 * 256);
  EXPECT_EQ(texture.sample(at(10.5), at(10), 0.5f), 120 * 256);
  EXPECT_EQ(texture.sample(at(10), at(10.25), 0.5f), 80 * 256);
  for (const float footprint : {2.0f, 3.0f, 20.0f, 1e6f})
    EXPECT_EQ(texture.sample(at(17.3), at(30.1), footprint), 120 * 256) << footprint;
  EXPECT_EQ(texture.sample(at(-50), at(-50), 0.5f), 40 * 256) << "outside, the edge";
  EXPECT_EQ(texture.sample(at(1e5), 0, 0.5f), 200 * 256);
}

}  // namespace
