// The files of one MRCLAM robot, valid and invalid.
#include "incognita/io/recordings/range_recording.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/io/notes.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

/// A folder of MRCLAM files of robot 2, valid except for what a test changes.
struct Mrclam {
  std::map<std::string, std::string> files = {
      {"Barcodes.dat", "# Subject # Barcode #\n  1 \t 5 \n  2 \t 14\n  6 \t 63\n  7 \t 25\n"},
      {"Landmark_Groundtruth.dat", "# Subject x y\n 6 1.5 -4 0.1 0.2\n 7 2 3 0.1 0.1\n"},
      {"Robot2_Odometry.dat", "# t v w\n100.5 \t 0.086 \t -0.398 \n100.7 0 0\n100.9 0.05 0.1\n"},
      {"Robot2_Measurement.dat",
       "# t c r b\n100.6 63 1.5 0.25\n100.6 25 2 -0.5\n100.65 5 1 0\n100.8 99 1 0\n"},
      {"Robot2_Groundtruth.dat", "# t x y a\n100.4 1 2 -1.75\n100.5 1 2 -1.5\n100.9 1 2 -1.5\n"}};

  Mrclam& with(const std::string& name, const std::string& text) {
    files[name] = text;
    return *this;
  }
  Mrclam& without(const std::string& name) {
    files.erase(name);
    return *this;
  }
  RangeRecording read(int robot = 2, const std::string& format = "auto") const {
    const Scratch scratch;
    for (const auto& [name, text] : files) scratch.write(name, text);
    return read_range_recording(scratch.folder(), format, robot);
  }
  std::string complaint(int robot = 2) const {
    return message_of([&] { read(robot); });
  }
};

TEST(Mrclam, IsReadAsASingleRobot) {
  const RangeRecording recording = Mrclam().read();
  EXPECT_EQ(recording.format, "mrclam");
  EXPECT_EQ(recording.vehicle, "differential-drive");
  ASSERT_EQ(recording.odometry.size(), 3u);
  EXPECT_EQ(recording.odometry[0].t, 100.5);
  EXPECT_EQ(recording.odometry[0].input, Eigen::Vector2d(0.086, -0.398));
  ASSERT_EQ(recording.scans.size(), 3u) << "measurements of one time are one scan";
  ASSERT_EQ(recording.scans[0].detections.size(), 2u);
  EXPECT_EQ(recording.scans[0].detections[0].identity, 6);
  EXPECT_EQ(recording.scans[0].detections[1].identity, 7);
  EXPECT_EQ(recording.scans[0].detections[1].range_m, 2);
  EXPECT_EQ(recording.scans[0].detections[1].bearing_rad, -0.5);
  EXPECT_TRUE(recording.scans[1].detections.empty()) << "it detected only another robot";
  ASSERT_EQ(recording.truth.size(), 3u);
  EXPECT_EQ(recording.truth[0].heading_rad, -1.75);
  ASSERT_EQ(recording.landmarks.size(), 2u);
  EXPECT_EQ(recording.landmarks[0].identity, 6);
  EXPECT_EQ(recording.landmarks[0].position, Eigen::Vector2d(1.5, -4));
  const std::string notes = all_notes(recording);
  EXPECT_HAS(notes, "detected format `mrclam`");
  EXPECT_HAS(notes, "1 measurements of other robots are omitted, the first at ");
  EXPECT_HAS(notes, "1 measurements of barcodes that are not in Barcodes.dat are skipped, the first at ");
  EXPECT_HAS(notes, "Robot2_Measurement.dat:5");
}

TEST(Mrclam, WorksWithoutTruthAndLandmarks) {
  const RangeRecording recording =
      Mrclam().without("Robot2_Groundtruth.dat").without("Landmark_Groundtruth.dat").read();
  EXPECT_TRUE(recording.truth.empty());
  EXPECT_TRUE(recording.landmarks.empty());
  EXPECT_HAS(all_notes(recording), "there is no Robot2_Groundtruth.dat: the truth is unknown");
  EXPECT_HAS(all_notes(recording), "there is no Landmark_Groundtruth.dat");
}

TEST(Mrclam, RefusesInvalidFiles) {
  EXPECT_HAS(Mrclam().complaint(6), "recording.robot = 6: must be 1 to 5");
  EXPECT_HAS(Mrclam().complaint(3), "Robot3_Odometry.dat: does not exist; there is odometry of robot 2");
  EXPECT_HAS(Mrclam().without("Robot2_Odometry.dat").complaint(), "there is no odometry of any robot");
  EXPECT_HAS(Mrclam().without("Robot2_Measurement.dat").complaint(),
             "Robot2_Measurement.dat: cannot be read");
  EXPECT_HAS(Mrclam().with("Barcodes.dat", "# none\n").complaint(), "Barcodes.dat: lists no barcodes");
  EXPECT_HAS(Mrclam().with("Barcodes.dat", "6 5\n7 5\n").complaint(),
             "Barcodes.dat:2: barcode 5 is already that of subject 6");
  EXPECT_HAS(Mrclam().with("Barcodes.dat", "6 5.5\n").complaint(),
             "Barcodes.dat:1: column 2 must be a whole number from 0, and is `5.5`");
  EXPECT_HAS(Mrclam().with("Robot2_Odometry.dat", "# none\n").complaint(), "there is no odometry");
  EXPECT_HAS(Mrclam().with("Robot2_Measurement.dat", "# none\n").complaint(), "there are no scans");
  EXPECT_HAS(Mrclam().with("Robot2_Odometry.dat", "1 0 0\n0 0 0\n").complaint(),
             "Robot2_Odometry.dat:2: the times must not go backwards");
  EXPECT_HAS(Mrclam().with("Robot2_Odometry.dat", "1 nan 0\n").complaint(),
             "Robot2_Odometry.dat:1: column 2 must be a number, and is `nan`");
  EXPECT_HAS(Mrclam().with("Robot2_Measurement.dat", "100.6 63 1\n").complaint(),
             "Robot2_Measurement.dat:1: has 3 columns, column 4 is required");
  EXPECT_HAS(Mrclam().with("Robot2_Groundtruth.dat", "2 0 0 0\n1 0 0 0\n").complaint(),
             "Robot2_Groundtruth.dat:2: the times must not go backwards");
  EXPECT_HAS(Mrclam().with("Landmark_Groundtruth.dat", "6 0 0\n6 1 1\n").complaint(),
             "Landmark_Groundtruth.dat:2: there is already a landmark 6");
  EXPECT_HAS(Mrclam().with("Robot2_Measurement.dat", "1 63 1 0\n").complaint(), "do not overlap in time");
}

}  // namespace
}  // namespace incognita
