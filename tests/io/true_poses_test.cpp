// True poses beside a recording, and the KITTI odometry benchmark, whose truth are such matrices.
#include "incognita/io/recordings/true_poses.hpp"

#include <gtest/gtest.h>

#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::pgm;
using testing::Scratch;

const std::vector<Recording::RecordedFrame> two_frames{{10, {}}, {10.5, {}}};

/// A quarter turn about z, at 1, 2, 3.
const char* const turned = "0 -1 0 1 1 0 0 2 0 0 1 3";

std::string complaint(const std::string& text) {
  const Scratch scratch;
  scratch.write("poses.txt", text);
  return message_of([&] { read_true_poses(scratch / "poses.txt", two_frames); });
}

void expect_turned(const RecordedPose& pose, double t) {
  EXPECT_EQ(pose.t, t);
  EXPECT_EQ(pose.position, Eigen::Vector3d(1, 2, 3));
  const double half = std::sqrt(0.5);
  EXPECT_LT((pose.world_from_camera - Eigen::Vector4d(half, 0, 0, half)).norm(), 1e-12);
}

TEST(TruePoses, AreMatricesOnALineOrInRows) {
  const Scratch scratch;
  const std::string line = turned;
  scratch.write("12.txt", line + "\n" + line + "\n");
  scratch.write("16.txt", line + " 0 0 0 1\n# comment\n" + line + " 0 0 0 1\n");
  const std::string rows = "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n";
  scratch.write("rows.txt", rows + "\n" + rows);
  for (const char* name : {"12.txt", "16.txt", "rows.txt"}) {
    const auto poses = read_true_poses(scratch / name, two_frames);
    ASSERT_EQ(poses.size(), 2u) << name;
    expect_turned(poses[0], 10);
    expect_turned(poses[1], 10.5);
  }
}

TEST(TruePoses, MayBeOneFileEachInNaturalOrder) {
  const Scratch scratch;
  scratch.write("poses/frame-10.txt", "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n");
  scratch.write("poses/frame-9.txt", "1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n");
  scratch.write("poses/notes.md", "not a pose");
  const auto poses = read_true_poses(scratch / "poses", two_frames);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].position, Eigen::Vector3d(7, 8, 9));
  expect_turned(poses[1], 10.5);
  scratch.write("poses/frame-11.txt",
                "1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n");
  EXPECT_HAS(message_of([&] { read_true_poses(scratch / "poses", two_frames); }),
             "frame-11.txt: has 2 matrices");
}

TEST(TruePoses, AreOfTumByEightColumns) {
  const Scratch scratch;
  scratch.write("truth.txt", "9.9 1 2 3 0 0 0 1\n10.1 1 2 4 0 0 0 1\n10.4 1 2 5 0 0 0 1\n");
  const auto poses = read_true_poses(scratch / "truth.txt", two_frames);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[1].t, 10.1);
}

TEST(TruePoses, SayWhatIsWrong) {
  EXPECT_HAS(complaint(""), "poses.txt: has no poses");
  EXPECT_HAS(complaint("1 2 3\n"), "poses.txt:1: has 3 columns; poses have 8");
  EXPECT_HAS(complaint(std::string(turned) + "\n"), "has 1 matrices for 2 images");
  EXPECT_HAS(complaint("1 0 0 0\n0 1 0 0\n0 0 1 0\n"), "has 3 lines, which is not a multiple of the 4 rows");
  EXPECT_HAS(complaint("1 0 0 0\n0 1 0 0\n0 0 1\n0 0 0 1\n"),
             "poses.txt:3: has 3 columns, the lines before have 4");
  EXPECT_HAS(complaint("1 0 0 0 0 1 0 0 0 0 -1 0\n"), "poses.txt:1: must be a rigid transformation");
  EXPECT_HAS(complaint("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2\n"), "the last row of a 4x4 pose must be 0 0 0 1");
  EXPECT_HAS(complaint("1 0 0 nan 0 1 0 0 0 0 1 0\n"), "poses.txt:1: column 4 must be a number");
}

LoadedScenario with_truth(const Scratch& scratch, const std::string& more) {
  scratch.write("s.toml", "[world]\ntype = \"recording\"\n[recording]\nfolder = \"" +
                              scratch.folder().string() + "\"\npattern = \"*.pgm\"\n" + more);
  return load_scenario((scratch / "s.toml").string());
}

TEST(TruePoses, AreThoseTheScenarioNamesWithItsOffset) {
  const Scratch scratch;
  for (const char* name : {"a0.pgm", "a1.pgm"}) scratch.write(name, pgm(320, 240));
  scratch.write("poses.txt", std::string(turned) + "\n" + turned + "\n");
  const Recording recording = read_recording(with_truth(
      scratch,
      "truth = \"poses.txt\"\ntruth_offset_s = 0.25\n[start]\nfrom = \"free\"\n[run]\nrate_hz = 10\n"));
  ASSERT_EQ(recording.truth.size(), 2u);
  expect_turned(recording.truth[1], 0.1 + 0.25);
  EXPECT_HAS(recording.notes.back(), "2 true poses from ");
  EXPECT_HAS(message_of([&] {
               read_recording(with_truth(scratch, "truth = \"none.txt\"\n[start]\nfrom = \"free\"\n"));
             }),
             "recording.truth");
  EXPECT_HAS(
      message_of([&] { with_truth(scratch, "truth_frame = \"estimate\"\n[start]\nfrom = \"free\"\n"); }),
      "recording.truth_frame = \"estimate\": must be `own` without a target");
}

/// P0 and P2 as in the benchmark: camera 2 is 6 cm left of camera 0.
const char* const calib =
    "P0: 700 0 600 0 0 700 180 0 0 0 1 0\nP1: 700 0 600 -380 0 700 180 0 0 0 1 0\n"
    "P2: 700 0 600 42 0 700 180 14 0 0 1 0.01\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";

void write_kitti(const Scratch& scratch, const std::string& folder, int camera) {
  const std::string images = folder + "/image_" + std::to_string(camera) + "/";
  scratch.write(folder + "/times.txt", "0.000000e+00\n1.037875e-01\n");
  scratch.write(images + "000000.png", "");
  scratch.write(images + "000001.png", "");
}

TEST(KittiRecording, HasTimesImagesAndThePublishedPoses) {
  const Scratch scratch;
  write_kitti(scratch, "sequences/07", 0);
  write_kitti(scratch, "sequences/07", 1);
  scratch.write("poses/07.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n" + std::string(turned) + "\n");
  for (const char* spelled : {"sequences/07", "sequences/07/"}) {
    const Recording recording = read_recording(scratch / spelled, "auto", 30);
    EXPECT_EQ(recording.format, "kitti");
    ASSERT_EQ(recording.frames.size(), 2u);
    EXPECT_EQ(recording.frames[1].image.filename(), "000001.png");
    EXPECT_DOUBLE_EQ(recording.frames[1].t, 0.1037875);
    ASSERT_EQ(recording.truth.size(), 2u);
    expect_turned(recording.truth[1], 0.1037875);
    EXPECT_HAS(recording.notes[1], "the images are those of image_0; not used are image_1");
    EXPECT_HAS(recording.notes[2], "no P0 in calib.txt");
  }
}

TEST(KittiRecording, MovesTheTruthToTheCameraInUse) {
  const Scratch scratch;
  write_kitti(scratch, "02", 2);
  scratch.write("02/poses.txt", std::string(turned) + "\n" + turned + "\n");
  const Recording without = read_recording(scratch / "02", "kitti", 30);
  EXPECT_HAS(without.notes.back(), "the truth is that of camera 0, not of camera 2");
  scratch.write("02/calib.txt", calib);
  const Recording recording = read_recording(scratch / "02", "kitti", 30);
  // The center c of camera 2 in camera 0 is where P2 [c; 1] = 0
  const Eigen::Vector3d center(-(42 - 600 * 0.01) / 700, -(14 - 180 * 0.01) / 700, -0.01);
  // World x is -y of camera 0, world y is its x
  EXPECT_LT((recording.truth.at(1).position - Eigen::Vector3d(1 - center.y(), 2 + center.x(), 3 + center.z()))
                .norm(),
            1e-12);
}

TEST(KittiRecording, TakesTheCameraFromItsCalibration) {
  const Scratch scratch;
  write_kitti(scratch, "00", 0);
  // a PNG header is enough for the size
  using namespace std::string_literals;
  scratch.write("00/image_0/000000.png",
                "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x04\xd8\0\0\x01\x78\x08\0\0\0\0"s + std::string(40, '\0'));
  scratch.write("00/calib.txt", calib);
  const auto camera = camera_in_kitti(scratch / "00");
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->camera.width_px, 1240);
  EXPECT_EQ(camera->camera.height_px, 376);
  EXPECT_EQ(camera->camera.fu_px, 700);
  EXPECT_EQ(camera->camera.u0_px, 600);
  scratch.write("s.toml", "[world]\ntype = \"recording\"\n[recording]\nfolder = \"" +
                              (scratch / "00").string() + "\"\n[start]\nfrom = \"free\"\n");
  const LoadedScenario loaded = load_scenario((scratch / "s.toml").string());
  EXPECT_EQ(loaded.scenario.camera.v0_px, 180);
  EXPECT_HAS(compare_camera(loaded, read_recording(loaded)), "the camera is taken from");
}

/// The scenario may give the camera.
TEST(KittiRecording, IsReadWhereNoCameraModelHoldsItsCalibration) {
  const Scratch scratch;
  write_kitti(scratch, "00", 0);
  using namespace std::string_literals;
  scratch.write("00/image_0/000000.png",
                "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x04\xd8\0\0\x01\x78\x08\0\0\0\0"s + std::string(40, '\0'));
  scratch.write("00/calib.txt", "P0: 700, 2, 600, 0, 0, 700, 180, 0, 0, 0, 1, 0\n");
  EXPECT_EQ(read_recording(scratch / "00", "auto", 30).frames.size(), 2u);
  const auto camera = camera_in_kitti(scratch / "00");
  ASSERT_TRUE(camera);
  EXPECT_HAS(camera->unfit, "line 1: P0 without its last column has a skew of 2");
}

TEST(KittiRecording, SaysWhatIsWrong) {
  const Scratch scratch;
  write_kitti(scratch, "00", 0);
  scratch.write("00/times.txt", "0\n");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "00", "auto", 30); }), "has 1 stamps for 2 images");
  scratch.write("00/times.txt", "0.1\n0.1\n");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "00", "auto", 30); }),
             "times.txt:2: the stamps must increase");
  scratch.write("00/times.txt", "0\n0.1\n");
  scratch.write("00/calib.txt", "P0: 1 2 3\n");
  EXPECT_HAS(message_of([&] { camera_in_kitti(scratch / "00"); }),
             "calib.txt:1: P0 must be followed by 12 numbers, and has 3");
  scratch.write("00/calib.txt", "\nP0: 700 0 600 0 0 0 180 0 0 0 1 0\n");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "00", "auto", 30); }),
             "calib.txt:2: P0 must have focal lengths of more than 0, and has 700 and 0");
  scratch.write("none/times.txt", "0\n");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "none", "kitti", 30); }),
             "none of the folders image_0");
}

}  // namespace
}  // namespace incognita
