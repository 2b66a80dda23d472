// Paths in tables: their meaning, and every kind of invalid file.
#include "incognita/io/formats/path_file.hpp"

#include <gtest/gtest.h>

#include "incognita/control/paths/reference_path.hpp"
#include "tests/io/damage.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

PathSamples read(const std::string& text) {
  const Scratch scratch;
  return read_path(scratch.write("p.csv", text));
}

std::string complaint(const std::string& text) {
  return message_of([&] { read(text); });
}

TEST(PathFile, IsRead) {
  const PathSamples plain = read("t,x,y\n0,1,2\n1.5,3,4\n");
  EXPECT_EQ(plain.t, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(plain.position[1], Eigen::Vector3d(3, 4, 0));
  EXPECT_TRUE(plain.heading.empty());
  const PathSamples full = read("# a walk\r\nt, x, y, z, heading\r\n-1,1,2,0.8,3\r\n\r\n1,3,4,0.9,-3\r\n");
  EXPECT_EQ(full.position[0], Eigen::Vector3d(1, 2, 0.8));
  EXPECT_EQ(full.heading, (std::vector<double>{3, -3}));
  EXPECT_EQ(read("heading,y,x,t\n1,2,3,4\n1,2,3,5\n").position[0], Eigen::Vector3d(3, 2, 0));
}

TEST(PathFile, RefusesInvalidPathsWithTheRemedy) {
  EXPECT_HAS(complaint(""), "p.csv: is empty; its first line must name the columns");
  EXPECT_HAS(complaint("t,x,y\n"), "p.csv: there are no rows");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n"), "p.csv:2: a path needs two rows or more");
  EXPECT_HAS(complaint("t,x\n0,1\n1,1\n"), "p.csv:1: there is no column `y`");
  EXPECT_HAS(complaint("0,1,2\n1,2,3\n"), "p.csv:1: a path has no column `0`");
  EXPECT_HAS(complaint("t,x,y,heding\n0,1,2,3\n1,1,2,3\n"), "no column `heding`; the nearest is `heading`");
  EXPECT_HAS(complaint("t,x,x\n0,1,2\n"), "p.csv:1: there are two columns `x`");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n1,2\n"), "p.csv:3: has 2 cells, the first line names 3 columns");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n1,two,3\n"), "p.csv:3: `x` must be a number, and is `two`");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n1,nan,3\n"), "p.csv:3: `x` must be a finite number");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n1,,3\n"), "p.csv:3: `x` must be a number");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n1,2e6,3\n"), "p.csv:3: `x` is 2000000");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n2,1,2\n2,1,3\n"),
             "p.csv:4: t = 2 must be later than 2 in the row before");
  EXPECT_HAS(complaint("t,x,y\n0,1,2\n-1,1,2\n"), "sort the rows by time");
  EXPECT_HAS(message_of([] { read_path("/nowhere/p.csv"); }), "/nowhere/p.csv: cannot be read");
}

TEST(PathFile, AnyAcceptedFileIsAValidPath) {
  std::string whole = "t,x,y,z,heading\n";
  for (int i = 0; i < 10; ++i) {
    const std::string n = std::to_string(i);
    whole += n + ".5," + n + ",-" + n + ",0.8,0." + n + "\n";
  }
  const Scratch scratch;
  const int fine = testing::still_read(whole, 500, [&](const std::string& text) {
    const Path path = through(read_path(scratch.write("p.csv", text)));
    check(path);
    const PathSpan span = span_of(path);
    const Reference middle = at(path, (span.start_s + span.end_s) / 2);
    EXPECT_TRUE(middle.position.allFinite() && middle.velocity.allFinite() &&
                middle.acceleration.allFinite());
  });
  EXPECT_GT(fine, 20);
  EXPECT_LT(fine, 490);
}

}  // namespace
}  // namespace incognita
