// MRCLAM recordings read as a team: robots with a common clock that detect each other, and every kind of
// broken file.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "incognita/io/recordings/range_formats.hpp"
#include "tests/io/notes.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

/// A folder with the robots 1, 2 and 4, valid except for what a test changes. Bar codes: 5, 14, 41 and 23 are
/// the robots 1, 2, 4 and 3, the last without files; 63 and 25 are the landmarks 6 and 7.
struct Team {
  std::map<std::string, std::string> files = {
      {"Barcodes.dat", "# Subject # Barcode #\n  1 \t 5 \n  2 \t 14\n3 23\n4 41\n  6 \t 63\n  7 \t 25\n"},
      {"Landmark_Groundtruth.dat", "# Subject x y\n 6 1.5 -4 0.1 0.2\n 7 2 3 0.1 0.1\n"},
      {"Robot1_Odometry.dat", "# t v w\n100.5 0.1 -0.4\n100.7 0 0\n100.9 0.05 0.1\n"},
      {"Robot1_Measurement.dat",
       "# t c r b\n100.6 63 1.5 0.25\n100.6 14 2 -0.5\n100.7 41 3 0.125\n100.8 99 1 0\n"},
      {"Robot1_Groundtruth.dat", "# t x y a\n100.4 1 2 -1.75\n100.9 1 2 -1.5\n"},
      {"Robot2_Odometry.dat", "100.6 0.2 0\n101 0.3 0.1\n"},
      {"Robot2_Measurement.dat", "100.65 5 2 3\n100.65 23 4 0\n100.65 25 1 -1\n100.9 41 0 0.5\n"},
      {"Robot4_Odometry.dat", "100 0 0\n102 1 1\n"},
      {"Robot4_Measurement.dat", "101 14 5 4\n101 5 6 0.75\n"}};

  Team& with(const std::string& name, const std::string& text) {
    files[name] = text;
    return *this;
  }
  Team& without(const std::string& name) {
    files.erase(name);
    return *this;
  }
  std::vector<RangeRecording> read() const {
    const Scratch scratch;
    for (const auto& [name, text] : files) scratch.write(name, text);
    return read_mrclam_team(scratch.folder());
  }
  std::string complaint() const {
    return message_of([&] { read(); });
  }
};

/// Robot 4 has index 2 in the team.
TEST(MrclamTeam, HasEveryRobotWithOdometryInTheOrderOfNumbers) {
  const std::vector<RangeRecording> team = Team().read();
  ASSERT_EQ(team.size(), 3u);
  EXPECT_EQ(team[0].odometry.size(), 3u);
  EXPECT_EQ(team[1].odometry[1].input, Eigen::Vector2d(0.3, 0.1));
  EXPECT_EQ(team[2].odometry[1].t, 102);
  for (const RangeRecording& robot : team) {
    EXPECT_EQ(robot.format, "mrclam");
    EXPECT_EQ(robot.vehicle, "differential-drive");
    ASSERT_EQ(robot.landmarks.size(), 2u) << "each robot has the survey";
    EXPECT_EQ(robot.landmarks[1].identity, 7);
    EXPECT_EQ(robot.landmarks[1].position, Eigen::Vector2d(2, 3));
  }
  ASSERT_EQ(team[0].truth.size(), 2u);
  EXPECT_TRUE(team[1].truth.empty());
  EXPECT_HAS(all_notes(team[1]), "there is no Robot2_Groundtruth.dat: the truth is unknown");
}

TEST(MrclamTeam, KeepsTheClockOfTheFiles) {
  const std::vector<RangeRecording> team = Team().read();
  EXPECT_EQ(team[0].odometry[0].t, 100.5);
  EXPECT_EQ(team[1].odometry[0].t, 100.6);
  EXPECT_EQ(team[2].odometry[0].t, 100);
  EXPECT_EQ(team[0].scans[0].t, 100.6);
  EXPECT_EQ(team[1].scans[0].t, 100.65);
  EXPECT_EQ(team[2].scans[0].t, 101);
  EXPECT_EQ(team[0].truth[0].t, 100.4);
}

TEST(MrclamTeam, DetectsRobotsByIndexAndLandmarksByNumber) {
  const std::vector<RangeRecording> team = Team().read();
  ASSERT_EQ(team[0].scans.size(), 3u) << "each time is one scan, also without known landmarks";
  ASSERT_EQ(team[0].scans[0].detections.size(), 1u);
  EXPECT_EQ(team[0].scans[0].detections[0].identity, 6);
  EXPECT_EQ(team[0].scans[0].detections[0].range_m, 1.5);
  ASSERT_EQ(team[0].scans[0].vehicles.size(), 1u);
  EXPECT_EQ(team[0].scans[0].vehicles[0].identity, 1);
  EXPECT_EQ(team[0].scans[0].vehicles[0].bearing_rad, -0.5);
  ASSERT_EQ(team[0].scans[1].vehicles.size(), 1u);
  EXPECT_EQ(team[0].scans[1].vehicles[0].identity, 2) << "robot 4";
  EXPECT_TRUE(team[0].scans[1].detections.empty());
  EXPECT_TRUE(team[0].scans[2].vehicles.empty());

  ASSERT_EQ(team[1].scans[0].vehicles.size(), 1u) << "robot 3 is not a member";
  EXPECT_EQ(team[1].scans[0].vehicles[0].identity, 0);
  EXPECT_EQ(team[1].scans[0].detections.at(0).identity, 7);
  ASSERT_EQ(team[2].scans[0].vehicles.size(), 2u);
  EXPECT_EQ(team[2].scans[0].vehicles[0].identity, 1);
  EXPECT_NEAR(team[2].scans[0].vehicles[0].bearing_rad, 4 - 2 * M_PI, 1e-12) << "within half a turn";
  EXPECT_EQ(team[2].scans[0].vehicles[1].identity, 0);
}

TEST(MrclamTeam, ReportsWhatItOmits) {
  const std::vector<RangeRecording> team = Team().read();
  EXPECT_HAS(all_notes(team[0]),
             "1 measurements of barcodes that are not in Barcodes.dat are skipped, the first at ");
  EXPECT_HAS(all_notes(team[0]), "Robot1_Measurement.dat:5");
  EXPECT_EQ(all_notes(team[0]).find("other robots"), std::string::npos);
  EXPECT_HAS(all_notes(team[1]), "1 measurements of other robots are omitted, the first at ");
  EXPECT_HAS(all_notes(team[1]), "Robot2_Measurement.dat:2");
  EXPECT_HAS(all_notes(team[1]),
             "1 detections without a positive range and a bearing are skipped, the first at ");
  EXPECT_HAS(all_notes(team[1]), "Robot2_Measurement.dat:4");
  EXPECT_TRUE(team[1].scans[1].vehicles.empty()) << "undefined at zero distance";
}

/// The robot's own bar code, or a misread one, is of no use to a filter.
TEST(MrclamTeam, ARobotDoesNotDetectItself) {
  const auto team = Team().with("Robot2_Measurement.dat", "100.65 14 2 1\n100.65 5 2 1\n").read();
  ASSERT_EQ(team[1].scans[0].vehicles.size(), 1u);
  EXPECT_EQ(team[1].scans[0].vehicles[0].identity, 0);
  EXPECT_HAS(all_notes(team[1]), "1 measurements of the robot's own barcode are skipped, the first at ");
}

TEST(MrclamTeam, OneRobotIsATeamWithoutOthers) {
  const Team alone = Team().without("Robot2_Odometry.dat").without("Robot4_Odometry.dat");
  const std::vector<RangeRecording> team = alone.read();
  ASSERT_EQ(team.size(), 1u);
  for (const RangeRecording::Scan& scan : team[0].scans) EXPECT_TRUE(scan.vehicles.empty());
  EXPECT_HAS(all_notes(team[0]), "2 measurements of other robots are omitted");
}

TEST(MrclamTeam, NamesMissingFiles) {
  EXPECT_HAS(Team().without("Barcodes.dat").complaint(), "Barcodes.dat: cannot be read");
  EXPECT_HAS(Team().without("Robot4_Measurement.dat").complaint(), "Robot4_Measurement.dat: cannot be read");
  Team none;
  for (const char* robot : {"1", "2", "4"}) none.without("Robot" + std::string(robot) + "_Odometry.dat");
  EXPECT_HAS(none.complaint(), "Robot1_Odometry.dat: does not exist; there is no odometry of any robot");
  const Scratch empty;
  EXPECT_HAS(message_of([&] { read_mrclam_team(empty.folder()); }), "there is no odometry of any robot");
  EXPECT_HAS(message_of([&] { read_mrclam_team(empty / "none"); }), "there is no odometry of any robot");
  const auto without = Team().without("Landmark_Groundtruth.dat").read();
  for (const RangeRecording& robot : without) {
    EXPECT_TRUE(robot.landmarks.empty());
    EXPECT_HAS(all_notes(robot), "there is no Landmark_Groundtruth.dat");
  }
}

/// Errors in the file of any robot name the file, the line and the remedy.
TEST(MrclamTeam, RefusesInvalidFiles) {
  const auto with = [](const char* name, const char* text) { return Team().with(name, text).complaint(); };
  EXPECT_HAS(with("Robot2_Odometry.dat", "100.6 0.2 0\n101 fast 0\n"),
             "Robot2_Odometry.dat:2: column 2 must be a number, and is `fast`");
  EXPECT_HAS(with("Robot2_Odometry.dat", "100.6 0.2\n"),
             "Robot2_Odometry.dat:1: has 2 columns, column 3 is required");
  EXPECT_HAS(
      with("Robot2_Odometry.dat", "100.6 0.2 0\n100 0 0\n"),
      "Robot2_Odometry.dat:2: the times must not go backwards: 100 comes after 100.6; sort the rows by time");
  EXPECT_HAS(with("Robot2_Odometry.dat", ""), "robot 2: there is no odometry");
  EXPECT_HAS(with("Robot4_Measurement.dat", "\x01\xff\x00garbage\n"), "Robot4_Measurement.dat:1: ");
  EXPECT_HAS(
      with("Robot4_Measurement.dat", "101 14 5 180\n"),
      "Robot4_Measurement.dat:1: the bearing must be within +-6.283 rad, and is 180; is it in degrees?");
  EXPECT_HAS(with("Robot4_Measurement.dat", "101 63.5 5 1\n"),
             "Robot4_Measurement.dat:1: column 2 must be a whole number from 0, and is `63.5`");
  EXPECT_HAS(with("Robot4_Measurement.dat", "# nothing\n"), "robot 4: there are no scans");
  EXPECT_HAS(with("Robot4_Measurement.dat", "500 14 5 1\n"),
             "robot 4: the odometry (100 s to 102 s) and the scans (500 s to 500 s) do not overlap in time");
  EXPECT_HAS(with("Robot1_Groundtruth.dat", "1 2 3\n"),
             "Robot1_Groundtruth.dat:1: has 3 columns, column 4 is required");
  EXPECT_HAS(with("Barcodes.dat", "1 5\n2 5\n"), "Barcodes.dat:2: barcode 5 is already that of subject 1");
  EXPECT_HAS(with("Landmark_Groundtruth.dat", "6 0 0\n6 1 1\n"),
             "Landmark_Groundtruth.dat:2: there is already a landmark 6");
}

}  // namespace
}  // namespace incognita
