// `incognita target` as a user runs it.
#include <gtest/gtest.h>

#include "incognita/io/scenario/target_file.hpp"
#include "incognita/io/targets/printed_target.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "tests/app/program.hpp"
#include "tests/io/photographed_sheet.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;
using testing::Words;

TEST(ProgramTarget, PrintsASheetWithItsFile) {
  const Scratch scratch;
  const Ended done =
      testing::incognita({"target", "--print", "--paper", "letter", "--out", "sheet.pdf"}, scratch.folder());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_SAYS(done.out, "written: sheet.pdf, Letter landscape: print it at 100 %");
  EXPECT_SAYS(done.out, "from = \"target\", target = \"sheet.toml\"");
  EXPECT_EQ(testing::contents(scratch / "sheet.pdf"), target_pdf(*paper_of("letter")));
  EXPECT_EQ(read_target(scratch / "sheet.toml").corners.size(), 8u);
  EXPECT_EQ(testing::incognita({"target", "--print"}, scratch.folder()).code, 0);
  EXPECT_EQ(read_target(scratch / "target.toml").name, "target");
}

TEST(ProgramTarget, ReplacesOnlyTargetsOfItsOwn) {
  const Scratch scratch;
  const auto print = [&](const char* out) {
    return testing::incognita({"target", "--print", "--out", out}, scratch.folder());
  };
  const auto refused = [&](const char* file) {
    scratch.write(file, "mine");
    const Ended ended = print("sheet.pdf");
    EXPECT_EQ(ended.code, 2) << file;
    EXPECT_SAYS(ended.err, std::string(file) + ": exists, and is not of a target");
    EXPECT_EQ(testing::contents(scratch / file), "mine");
    std::filesystem::remove(scratch / file);
    EXPECT_TRUE(std::filesystem::is_empty(scratch.folder())) << "something was written";
  };
  for (const char* file : {"sheet.toml", "sheet.pdf", "sheet.pgm", "sheet-7.pgm"}) refused(file);
  EXPECT_EQ(print("sheet.pdf").code, 0);
  const Ended again = print("sheet");
  EXPECT_EQ(again.code, 0) << again.err;
}

TEST(ProgramTarget, RefusesOptionsThatDoNotApply) {
  const Scratch scratch;
  const auto refused = [&](const Words& words) {
    const Ended ended = testing::incognita(words, scratch.folder());
    EXPECT_EQ(ended.code, 2);
    return ended.err;
  };
  EXPECT_SAYS(refused({"target", "--print", "--size", "0.2x0.1"}),
              "--size is for a target from a photograph");
  EXPECT_SAYS(refused({"target", "--print", "--camera", "c.toml"}),
              "--camera is for a target from a photograph");
  EXPECT_SAYS(refused({"target", "--print", "--corners", "1,1", "2,1", "2,2", "1,2"}),
              "--corners is for a target from a photograph");
  EXPECT_SAYS(refused({"target", "poster.pgm", "--paper", "a4"}), "--paper is for --print");
  EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
}

class CutByProgram : public ::testing::Test {
 protected:
  CutByProgram() {
    const Paper paper = *paper_of("a4");
    const PinholeCamera camera{640, 480, 540, 540, 322, 238, 0, 0, 0, 0, 0};
    const Eigen::Vector3d position(-0.45, 0.1, 0.05);
    const Eigen::Matrix3d R = testing::gaze_at({0, 0, 0}, position);
    const Image image =
        testing::photograph_sheet({target_sheet_image(paper, 4), 0.297, 0.21}, Camera(camera), position, R);
    std::string pgm = "P5\n640 480\n255\n";
    pgm.append(reinterpret_cast<const char*>(image.row(0)), 640 * 480);
    scratch_.write("poster.pgm", pgm);
    for (const auto& [left, up] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      const Eigen::Vector2d pixel =
          camera.project(R.transpose() * (Eigen::Vector3d(0, left * 0.105, up * 0.07425) - position)).pixel;
      corners_.push_back(std::to_string(pixel.x()) + "," + std::to_string(pixel.y()));
    }
  }
  Ended cut(const Words& more) const {
    Words words = {"target", "poster.pgm", "--corners"};
    words.insert(words.end(), corners_.begin(), corners_.end());
    words.insert(words.end(), more.begin(), more.end());
    return testing::incognita(words, scratch_.folder());
  }
  std::string refused(const Words& more) const {
    const Ended ended = cut(more);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "target.toml"));
    return ended.err;
  }
  Scratch scratch_;
  Words corners_;
};

TEST_F(CutByProgram, MakesATargetFile) {
  const Ended done = cut({"--size", "0.21x0.1485", "--out", "wall"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_SAYS(done.out, "written: wall.toml, with 4 corners");
  EXPECT_SAYS(done.err, "without --camera the photograph must be free of distortion");
  EXPECT_EQ(read_target(scratch_ / "wall.toml").corners[0].position, Eigen::Vector3d(0, 0.105, 0.07425));
}

TEST_F(CutByProgram, NeverOverwritesThePhotograph) {
  const std::string before = testing::contents(scratch_ / "poster.pgm");
  const Words own_name = {"--size", "0.21x0.1485", "--out", "poster"};
  EXPECT_SAYS(refused(own_name), "poster.pgm: is the photograph, and would be overwritten");
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "poster.toml"));
  scratch_.write("poster.toml", "# Cut by `incognita target` from another.jpg\n");
  EXPECT_SAYS(refused(own_name), "poster.pgm: is the photograph, and would be overwritten");
  EXPECT_EQ(testing::contents(scratch_ / "poster.pgm"), before);
  for (int k = 0; k < 2; ++k) EXPECT_EQ(cut({"--size", "0.21x0.1485", "--out", "wall"}).code, 0);
}

TEST_F(CutByProgram, ChecksTheCalibration) {
  scratch_.write("camera.txt", "fx 540\nfy 540\ncx 322\ncy 238\nwidth 640\nheight 480\n");
  EXPECT_EQ(cut({"--size", "0.21x0.1485", "--camera", "camera.txt"}).code, 0);
  std::filesystem::remove(scratch_ / "target.toml");
  scratch_.write("other.txt", "fx 540\nfy 540\ncx 322\ncy 238\nwidth 1280\nheight 960\n");
  EXPECT_SAYS(refused({"--size", "0.21x0.1485", "--camera", "other.txt"}),
              "other.txt: is for images of 1280x960 px, and poster.pgm has 640x480");
}

TEST_F(CutByProgram, UsageErrorsSayWhatToDo) {
  EXPECT_SAYS(refused({}), "--size is required: width and height between the corners, m, as 0.21x0.149");
  EXPECT_SAYS(refused({"--size", "0.21"}), "--size: must be width and height between the corners");
  EXPECT_SAYS(refused({"--size", "210x148"}), "--size 210x148: must be in m, 0.005 to 100");
  EXPECT_SAYS(refused({"--size", "0.21x0.1485", "--out", "nowhere/x"}), "nowhere: is no folder");
  corners_[1] = "12";
  EXPECT_SAYS(refused({"--size", "0.21x0.1485"}), "corner 1 must be u,v in px, as 120.5,80, and is `12`");
  corners_[1] = "1200,30";
  EXPECT_SAYS(refused({"--size", "0.21x0.1485"}),
              "poster.pgm: corner 1 (upper right) at (1200, 30): is outside");
  const Ended none = testing::incognita({"target"}, scratch_.folder());
  EXPECT_EQ(none.code, 2);
  EXPECT_SAYS(none.err, "IMAGE is required, or --print");
  const Ended gone = testing::incognita({"target", "gone.png"}, scratch_.folder());
  EXPECT_EQ(gone.code, 2);
  EXPECT_SAYS(gone.err, "gone.png: cannot be read");
}

}  // namespace
}  // namespace incognita
