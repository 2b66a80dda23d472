// Target files: their meaning, and every kind of invalid file.
#include "incognita/io/scenario/target_file.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::pgm;
using testing::Scratch;

std::string corner(const std::string& position, const std::string& patch = "p.pgm") {
  return "[[corner]]\nposition_m = " + position + "\npatch = \"" + patch + "\"\n";
}

const std::string head = "name = \"sheet\"\nnormal = [-1, 0, 0]\n";
const std::string three = corner("[3, 0.2, 1]") + corner("[3, -0.2, 1]") + corner("[3, 0.2, 1.5]");
const std::string four = three + corner("[3, -0.2, 1.5]");

std::string complaint(const std::string& toml) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  scratch.write("even.pgm", pgm(12, 12));
  scratch.write("oblong.pgm", pgm(11, 13));
  scratch.write("small.pgm", pgm(7, 7));
  scratch.write("cut.pgm", pgm(11, 11).substr(0, 50));
  scratch.write("flat.pgm", "P5\n11 11\n255\n" + std::string(121, 'x'));
  const std::filesystem::path file = scratch.write("t.toml", toml);
  return message_of([&] { read_target(file); });
}

TEST(Target, IsRead) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  scratch.write("elsewhere/q.pgm", pgm(15, 15, 3));
  const Target target = read_target(scratch.write("t.toml", "name = \"sheet\"\nnormal = [-2, 0, 0]\n" +
                                                                three + corner("[3, -0.2, 1.5]", "q.pgm")),
                                    {scratch.folder() / "elsewhere"});
  EXPECT_EQ(target.name, "sheet");
  EXPECT_EQ(target.normal, Eigen::Vector3d(-1, 0, 0));
  ASSERT_EQ(target.corners.size(), 4u);
  EXPECT_EQ(target.corners[1].position, Eigen::Vector3d(3, -0.2, 1));
  EXPECT_EQ(target.corners[0].patch.width(), 11);
  EXPECT_EQ(target.corners[3].patch.width(), 15);
  EXPECT_EQ(target.corners[3].patch(1, 0), 6);
}

TEST(Target, ConvertsSceneLibsAxes) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  const Target target = read_target(scratch.write(
      "t.toml", "name = \"a\"\naxes = \"scenelib\"\nnormal = [0, 0, -1]\n" + corner("[0.1, 0.07, 0]") +
                    corner("[-0.1, 0.07, 0]") + corner("[0.1, -0.07, 0]") + corner("[-0.1, -0.07, 0]")));
  EXPECT_EQ(target.normal, Eigen::Vector3d(-1, 0, 0));                   // opposite to forward
  EXPECT_EQ(target.corners[0].position, Eigen::Vector3d(0, 0.1, 0.07));  // left and up are unchanged
  EXPECT_EQ(target.corners[3].position, Eigen::Vector3d(0, -0.1, -0.07));
}

TEST(Target, RefusesInvalidFiles) {
  EXPECT_EQ(complaint(head + four), "(none)");
  EXPECT_HAS(complaint(head + three),
             "t.toml:3: corner: must be 4 to 100 tables, written [[corner]], and is 3");
  EXPECT_HAS(complaint(head), "t.toml:1: corner: is missing");
  EXPECT_HAS(complaint("normal = [1, 0, 0]\n" + four), "name: is missing");
  EXPECT_HAS(complaint("name = \"x\"\n" + four), "normal: is missing");
  EXPECT_HAS(complaint("name = 3\n" + head.substr(15) + four), "t.toml:1: name: must be a text");
  EXPECT_HAS(complaint("name = \"x\"\nnormal = [0, 0, 0]\n" + four), "t.toml:2: normal: must not be zero");
  EXPECT_HAS(complaint("name = \"x\"\nnormal = [0, 1, 0]\n" + four), "normal: is not perpendicular");
  EXPECT_HAS(complaint("name = \"x\"\nnormal = [0, nan, 0]\n" + four),
             "t.toml:2: normal: must be a list of three finite");
  EXPECT_HAS(complaint(head + "axis = \"world\"\n" + four),
             "t.toml:3: axis: there is no such key in a target file; the nearest is `axes`");
  EXPECT_HAS(complaint(head + "axes = \"ros\"\n" + four),
             "t.toml:3: axes: must be `world` or `scenelib`, and is \"ros\"");
  EXPECT_HAS(complaint(head + three + corner("[3, -0.2]")),
             "t.toml:13: position_m: must be a list of three finite");
  EXPECT_HAS(complaint(head + three + "[[corner]]\nposition_m = [3, -0.2, 1.5]\n"),
             "t.toml:12: patch: is missing");
  EXPECT_HAS(complaint(head + three + corner("[3, -0.2, 1.5]") + "size = 3\n"),
             "t.toml:15: size: there is no such key");
  EXPECT_HAS(complaint(head + three + corner("[3, 0.2, 1.5]")),
             "position_m: corners 2 and 3 are at the same place");
  EXPECT_HAS(complaint(head + three + corner("[3.1, -0.2, 1.5]")),
             "position_m: the corners are not in one plane");
  EXPECT_HAS(complaint(head + corner("[3,0,1]") + corner("[3,0,2]") + corner("[3,0,3]") + corner("[3,0,4]")),
             "position_m: the corners are on one line");
}

TEST(Target, RefusesInvalidPatches) {
  const auto with = [](const char* patch) {
    return complaint(head + three + corner("[3, -0.2, 1.5]", patch));
  };
  EXPECT_HAS(with("none.pgm"), "t.toml:14: patch: none.pgm is not there");
  EXPECT_HAS(with("even.pgm"),
             "t.toml:14: patch: even.pgm must be an odd square of 9 to 101 px, and is 12x12");
  EXPECT_HAS(with("oblong.pgm"), "and is 11x13");
  EXPECT_HAS(with("small.pgm"), "and is 7x7");
  EXPECT_HAS(with("cut.pgm"), "cut.pgm: the file is truncated");
  EXPECT_HAS(with("flat.pgm"), "flat.pgm is of one gray");
  EXPECT_HAS(message_of([] { read_target("/nowhere/t.toml"); }),
             "/nowhere/t.toml: cannot be read: No such file");
}

/// A corner at pixel (u, v) of the picture.
std::string seen(const std::string& position, const std::string& pixel) {
  return corner(position) + "picture_px = " + pixel + "\n";
}

const std::string pictured = head + "picture = \"whole.pgm\"\n" + seen("[3, 0.2, 1]", "[10, 35]") +
                             seen("[3, -0.2, 1]", "[50, 35]") + seen("[3, 0.2, 1.2]", "[10, 15]");

TEST(Target, MayHaveAPicture) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  scratch.write("whole.pgm", pgm(60, 50));
  const Target target = read_target(scratch.write("t.toml", pictured + seen("[3, -0.2, 1.2]", "[50, 15]")));
  ASSERT_TRUE(target.picture);
  EXPECT_EQ(target.picture->image.width(), 60);
  for (const auto& [pixel, at] : {std::pair<Eigen::Vector3d, Eigen::Vector3d>{{10, 35, 1}, {3, 0.2, 1}},
                                  {{30, 25, 1}, {3, 0, 1.1}},
                                  {{0, 0, 1}, {3, 0.3, 1.35}}})
    EXPECT_NEAR((target.picture->world_from_px * pixel - at).norm(), 0, 1e-12);
}

/// 180x150 px are reduced to means over 2x2 px.
TEST(Target, ReducesAPictureToTheResolutionOfTheCamera) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  scratch.write("whole.pgm", pgm(180, 150));
  std::string text = head + "picture = \"whole.pgm\"\n" + seen("[3, 0.2, 1]", "[31, 106]") +
                     seen("[3, -0.2, 1]", "[151, 106]") + seen("[3, 0.2, 1.2]", "[31, 46]") +
                     seen("[3, -0.2, 1.2]", "[151, 46]");
  const Target target = read_target(scratch.write("t.toml", text));
  ASSERT_TRUE(target.picture);
  const Image& kept = target.picture->image;
  ASSERT_EQ(kept.width(), 90);
  ASSERT_EQ(kept.height(), 75);
  const Image whole = read_image(scratch.folder() / "whole.pgm");
  const int sum = whole(20, 30) + whole(21, 30) + whole(20, 31) + whole(21, 31);
  EXPECT_EQ(kept(10, 15), (sum + 2) / 4);
  EXPECT_NEAR(
      (target.picture->world_from_px * Eigen::Vector3d(15.25, 52.75, 1) - Eigen::Vector3d(3, 0.2, 1)).norm(),
      0, 1e-12)
      << "where the first corner is, between the pixels of the kept";
}

TEST(Target, RefusesInvalidPictures) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  scratch.write("whole.pgm", pgm(60, 50));
  scratch.write("flat.pgm", "P5\n11 11\n255\n" + std::string(121, 'x'));
  const auto complaint = [&](const std::string& text) {
    return message_of([&] { read_target(scratch.write("t.toml", text)); });
  };
  const std::string last = seen("[3, -0.2, 1.2]", "[50, 15]");
  EXPECT_EQ(complaint(pictured + last), "(none)");
  EXPECT_HAS(complaint(pictured + corner("[3, -0.2, 1.2]")), "t.toml:16: picture_px: is missing");
  EXPECT_HAS(complaint(pictured + seen("[3, -0.2, 1.2]", "[50]")),
             "picture_px: must be a list of two finite numbers");
  EXPECT_HAS(complaint(pictured + seen("[3, -0.2, 1.2]", "[45, 20]")),
             "t.toml:3: picture: must be a frontal view");
  const auto corners = [&](const std::vector<std::string>& pixels) {
    return complaint(head + "picture = \"whole.pgm\"\n" + seen("[3, 0.2, 1]", pixels[0]) +
                     seen("[3, -0.2, 1]", pixels[1]) + seen("[3, 0.2, 1.2]", pixels[2]) +
                     seen("[3, -0.2, 1.2]", pixels[3]));
  };
  EXPECT_HAS(corners({"[10, 35]", "[50, 45]", "[10, 15]", "[50, 25]"}), "degrees between rows and columns")
      << "sheared";
  EXPECT_HAS(corners({"[10, 25]", "[50, 25]", "[10, 15]", "[50, 15]"}),
             "a pixel is 0.01 m wide and 0.02 m high, with 90 degrees between rows and columns");
  EXPECT_HAS(corners({"[10, 15]", "[50, 15]", "[10, 15]", "[50, 15]"}),
             "corners 0 and 2 are less than 4 px apart");
  EXPECT_HAS(complaint(pictured + seen("[3, -0.2, 1.2]", "[60, 15]")),
             "t.toml:3: picture: must show the whole target, but picture_px of corner 3 is outside");
  EXPECT_HAS(complaint(head + "picture = \"whole.pgm\"\n" + seen("[3, 0.2, 1]", "[50, 35]") +
                       seen("[3, -0.2, 1]", "[10, 35]") + seen("[3, 0.2, 1.2]", "[50, 15]") +
                       seen("[3, -0.2, 1.2]", "[10, 15]")),
             "picture: is mirrored");
  const auto named = [&](const std::string& name) {
    return head + "picture = \"" + name + "\"\n" + pictured.substr(pictured.find("[[")) + last;
  };
  EXPECT_HAS(complaint(named("none.pgm")), "t.toml:3: picture: none.pgm is not there");
  EXPECT_HAS(complaint(named("flat.pgm")), "flat.pgm is of one gray");
  EXPECT_HAS(complaint(head + four + "picture_px = [1, 2]\n"), "picture_px: is of no use without `picture`");
}

/// As in docs/scenarios.md for a room of another length.
TEST(Target, FindsBuiltInPatches) {
  const Scratch scratch;
  std::string text = read_file(std::filesystem::path(embedded_root) / "targets/sheet.toml", 1 << 20);
  for (std::size_t at; (at = text.find("[3, ")) != std::string::npos;) text.replace(at, 4, "[5, ");
  scratch.write("mine.toml", text);
  const LoadedScenario loaded =
      load_scenario(scratch.write("s.toml", "[start]\ntarget = \"mine.toml\"\n").string());
  const Target target = load_target(loaded);
  EXPECT_EQ(target.corners[0].position.x(), 5);
  EXPECT_TRUE(target.picture);
  const auto complaint = [&](const std::string& patch) {
    std::string other = text;
    other.replace(other.find("sheet_corner0.pgm"), 17, patch);
    scratch.write("mine.toml", other);
    return message_of([&] { load_target(loaded); });
  };
  for (const char* outside : {"../../x", "../../../../sheet_corner0.pgm"})
    EXPECT_HAS(complaint(outside), std::string("patch: ") + outside + " is not there");
  EXPECT_HAS(complaint("../room.toml"), "room.toml: ")
      << "a built-in file of that name exists, but is not an image";
}

TEST(Target, IsFoundBesideItsScenario) {
  const Scratch scratch;
  const std::string file = scratch.write("s.toml", "[start]\ntarget = \"mine.toml\"\n").string();
  const LoadedScenario loaded = load_scenario(file);
  EXPECT_HAS(message_of([&] { find_target(loaded); }),
             "s.toml:2: start.target = \"mine.toml\": there is no such file");
  scratch.write("mine.toml", head + four);
  scratch.write("p.pgm", pgm(11, 11));
  EXPECT_EQ(find_target(loaded), scratch.folder() / "mine.toml");
  EXPECT_EQ(load_target(loaded).corners.size(), 4u);
  // the printed path may be used from another folder
  const Scratch elsewhere;
  const LoadedScenario again = load_scenario(elsewhere.write("e.toml", effective_toml(loaded)).string());
  EXPECT_EQ(load_target(again).name, "sheet");
}

// The patches of Davison's recording agree with the corners: the printed rectangle, inside, is dark.
TEST(Target, PatchesOfDavisonAgreeWithTheirCorners) {
  const LoadedScenario davison = load_scenario("davison");
  Target target;
  try {
    target = load_target(davison);
  } catch (const InputError& error) {
    GTEST_SKIP() << error.what();
  }
  for (const Target::Corner& c : target.corners) {
    const Image& patch = c.patch;
    const auto gray = [&](bool right, bool low) { return patch(right ? 10 : 0, low ? 10 : 0); };
    const bool inside_is_right = c.position.y() > 0;  // world y is to the left
    const bool inside_is_low = c.position.z() > 0;
    for (const bool right : {false, true}) {
      for (const bool low : {false, true}) {
        EXPECT_EQ(gray(right, low) < 100, right == inside_is_right && low == inside_is_low);
      }
    }
  }
}

}  // namespace
}  // namespace incognita
