// Readers of targets, images and recordings under hundreds of small mutations: they accept or refuse, and
// never crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/recordings/range_recording.hpp"
#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "tests/io/damage.hpp"
#include "tests/io/mat_writer.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::pgm;
using testing::Scratch;
using testing::still_read;

TEST(DamagedTarget, IsReadOrRefused) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  std::string whole = "name = \"sheet\"\nnormal = [-1, 0, 0]\naxes = \"world\"\npicture = \"p.pgm\"\n";
  for (const char* at : {"[3, 0.2, 1]\npicture_px = [1, 10]", "[3, -0.2, 1]\npicture_px = [9, 10]",
                         "[3, 0.2, 1.5]\npicture_px = [1, 0]", "[3, -0.2, 1.5]\npicture_px = [9, 0]"})
    whole += std::string("[[corner]]\nposition_m = ") + at + "\npatch = \"p.pgm\"\n";
  const int fine = still_read(whole, 300, [&](const std::string& text) {
    const Target target = read_target(scratch.write("t.toml", text));
    EXPECT_NEAR(target.normal.norm(), 1, 1e-9);
    EXPECT_GE(target.corners.size(), 4u);
    for (const auto& corner : target.corners) EXPECT_TRUE(corner.position.allFinite());
  });
  EXPECT_GT(fine, 10);
  EXPECT_LT(fine, 290);
}

TEST(DamagedImage, IsReadOrRefused) {
  const Scratch scratch;
  cv::Mat picture(24, 32, CV_8U);
  for (int i = 0; i < 24 * 32; ++i) picture.data[i] = static_cast<unsigned char>(i * 7 + i / 32 * 5);
  for (const char* ending : {".pgm", ".png", ".jpg", ".bmp", ".tiff", ".webp"}) {
    std::vector<unsigned char> bytes;
    ASSERT_TRUE(cv::imencode(ending, picture, bytes));
    const std::filesystem::path file = scratch.folder() / (std::string("image") + ending);
    const int fine = still_read({bytes.begin(), bytes.end()}, 60, [&](const std::string& text) {
      const Image image = read_image(scratch.write(file.filename(), text));
      EXPECT_GT(image.width(), 0) << ending;
      EXPECT_GT(image.height(), 0) << ending;
    });
    EXPECT_LT(fine, 60) << ending;
  }
}

TEST(DamagedRecording, IsReadOrRefused) {
  const Scratch scratch;
  const std::string list = "# stamp file\n1.0 rgb/a.png\n1.1 rgb/b.png\n1.2 rgb/c.png\n";
  const std::string truth =
      "# t x y z qx qy qz qw\n1.0 0 0 1 0 0 0 1\n1.1 0.5 0 1 0 0 0.6 0.8\n1.2 1 0 1 0 0 0 1\n";
  const auto read = [&](const std::string& a, const std::string& b) {
    scratch.write("rgb.txt", a);
    scratch.write("groundtruth.txt", b);
    const Recording recording = read_recording(scratch.folder(), "tum", 30);
    EXPECT_FALSE(recording.frames.empty());
    for (std::size_t i = 1; i < recording.frames.size(); ++i)
      EXPECT_LT(recording.frames[i - 1].t, recording.frames[i].t);
    for (const RecordedPose& pose : recording.truth) {
      EXPECT_TRUE(std::isfinite(pose.t) && pose.position.allFinite());
      EXPECT_NEAR(pose.world_from_camera.norm(), 1, 1e-9);
    }
  };
  EXPECT_GT(still_read(list, 150, [&](const std::string& text) { read(text, truth); }), 15);
  EXPECT_GT(still_read(truth, 150, [&](const std::string& text) { read(list, text); }), 5);
}

/// Invariants of a range-bearing recording, whatever the files.
void expect_valid(const RangeRecording& recording) {
  const auto in_order = [](const auto& rows) {
    return std::is_sorted(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  };
  EXPECT_TRUE(in_order(recording.odometry) && in_order(recording.scans) && in_order(recording.truth));
  EXPECT_FALSE(recording.odometry.empty() || recording.scans.empty());
  for (const Odometry& one : recording.odometry) EXPECT_TRUE(std::isfinite(one.t) && one.input.allFinite());
  for (const RangeRecording::Scan& scan : recording.scans) {
    EXPECT_TRUE(std::isfinite(scan.t));
    for (const Detection& detection : scan.detections) {
      EXPECT_TRUE(std::isfinite(detection.range_m) && detection.range_m > 0);
      EXPECT_LE(std::abs(detection.bearing_rad), 3.1416);
      EXPECT_GE(detection.identity, Detection::unknown);
    }
  }
  for (const RangeRecording::TimedPosition& place : recording.truth)
    EXPECT_TRUE(std::isfinite(place.t) && place.position.allFinite() &&
                std::isfinite(place.heading_rad.value_or(0)));
  for (const RangeRecording::Landmark& landmark : recording.landmarks)
    EXPECT_TRUE(landmark.position.allFinite());
}

/// Mutates each file of an otherwise valid folder in turn.
void damage_each(const std::map<std::string, std::string>& files, const std::string& format) {
  const Scratch scratch;
  for (const auto& [name, whole] : files) scratch.write(name, whole);
  for (const auto& [name, whole] : files) {
    const int fine = still_read(whole, 150, [&, file = name](const std::string& text) {
      scratch.write(file, text);
      expect_valid(read_range_recording(scratch.folder(), format));
    });
    EXPECT_GT(fine, 5) << name;
    EXPECT_LT(fine, 150) << name;
    scratch.write(name, whole);
  }
}

TEST(DamagedRangeTables, AreReadOrRefused) {
  damage_each({{"odometry.csv", "t_s,speed_m_s,turn_rate_rad_s\n0,0.5,0\n0.1,0.5,0.2\n0.2,0.4,0.2\n"},
               {"detections.csv", "t_s,range_m,bearing_rad,identity\n0,2,0.5,7\n0.1,3,-0.25,\n0.2,,,\n"},
               {"truth.csv", "t_s,x_m,y_m,heading_rad\n0,1,2,3\n0.1,1.5,2,\n"},
               {"landmarks.csv", "identity,x_m,y_m\n7,3,4\n8,-3,4.5\n"}},
              "tables");
}

TEST(DamagedMrclam, IsReadOrRefused) {
  damage_each({{"Barcodes.dat", "# Subject Barcode\n 1 5\n 6 63\n 7 25\n"},
               {"Landmark_Groundtruth.dat", "# Subject x y\n 6 1.5 -4 0.1 0.2\n 7 2 3 0.1 0.1\n"},
               {"Robot1_Odometry.dat", "# t v w\n100.5 0.086 -0.398\n100.7 0 0\n100.9 0.05 0.1\n"},
               {"Robot1_Measurement.dat", "# t c r b\n100.6 63 1.5 0.25\n100.6 25 2 -0.5\n100.8 99 1 0\n"},
               {"Robot1_Groundtruth.dat", "# t x y a\n100.4 1 2 -1.75\n100.5 1 2 -1.5\n"}},
              "mrclam");
}

TEST(DamagedMatFile, IsReadOrRefused) {
  const Scratch scratch;
  testing::write_mat(scratch / "data_set.mat", testing::small_car_park());
  const std::string whole = testing::contents(scratch / "data_set.mat");
  const auto read = [&](const std::string& bytes) {
    scratch.write("data_set.mat", bytes);
    expect_valid(read_range_recording(scratch.folder(), "acfr"));
  };
  EXPECT_LT(still_read(whole, 300, read), 300);
  testing::write_mat(scratch / "data_set.mat", testing::small_car_park(), MAT_COMPRESSION_ZLIB);
  EXPECT_LT(still_read(testing::contents(scratch / "data_set.mat"), 300, read), 150);
  // Most of the file are numbers; the offsets of sizes and types matter
  for (std::size_t at = 0; at + 200 < whole.size(); at += at < 1200 ? 100 : 1700) {
    still_read(whole.substr(at, 200), 40,
               [&](const std::string& part) { read(whole.substr(0, at) + part + whole.substr(at + 200)); });
  }
}

}  // namespace
}  // namespace incognita
