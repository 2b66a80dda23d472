// Image recordings in every layout, and every kind of invalid file.
#include "incognita/io/recordings/recording.hpp"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/formats/image_files.hpp"
#include "incognita/io/formats/image_names.hpp"
#include "incognita/io/recordings/recorded_images.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::pgm;
using testing::Scratch;

SharedRecording share(Recording recording) { return std::make_shared<const Recording>(std::move(recording)); }

Tick at(double t) { return {1, t, 0.1}; }

TEST(ImageFolder, OrdersImagesNaturally) {
  const Scratch scratch;
  for (const char* name : {"img10.pgm", "img2.pgm", "img1.pgm", "img002b.pgm", "notes.txt", "z.PGM"}) {
    scratch.write(name, pgm(20, 16));
  }
  const Recording recording = read_recording(scratch.folder(), "auto", 25);
  ASSERT_EQ(recording.frames.size(), 5u);
  const char* order[] = {"img1.pgm", "img2.pgm", "img002b.pgm", "img10.pgm", "z.PGM"};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(recording.frames[k].image.filename(), order[k]);
    EXPECT_DOUBLE_EQ(recording.frames[k].t, static_cast<double>(k) / 25);
  }
  EXPECT_EQ(recording.format, "images");
  EXPECT_HAS(recording.notes.front(), "detected format `images`");
  EXPECT_HAS(recording.notes.back(), "1 files that are not images are ignored");
  EXPECT_TRUE(recording.truth.empty());
}

TEST(ImageFolder, IsInTheSameOrderAsASourceOfImages) {
  const Scratch scratch;
  for (const char* name : {"img10.pgm", "img2.PGM", "notes.txt", "img1.pgm"})
    scratch.write(name, pgm(20, 16));
  const auto images = open_images({scratch.folder()});
  EXPECT_EQ(images->count(), 3u);
  for (const char* name : {"img1.pgm", "img2.PGM", "img10.pgm"})
    EXPECT_EQ(images->next().value().name, (scratch / name).string());
  std::filesystem::create_directories(scratch / "empty");
  EXPECT_HAS(message_of([&] { open_images({scratch / "empty"}); }),
             "empty: there are no images in this folder");
  EXPECT_HAS(message_of([&] { images_in(scratch / "nowhere"); }), "nowhere: cannot be read: ");
}

std::string notes_on(const std::vector<std::string>& names) {
  const Scratch scratch;
  for (const std::string& name : names) scratch.write(name, pgm(20, 16));
  std::string all;
  for (const std::string& note : read_recording(scratch.folder(), "images", 25).notes) all += note + "\n";
  return all;
}

TEST(ImageFolder, ReportsMissingNumbers) {
  EXPECT_HAS(notes_on({"a8.pgm", "a9.pgm", "a11.pgm", "a12.pgm", "a13.pgm", "a16.pgm", "a17.pgm"}),
             "3 numbers are missing, the first between a9.pgm and a11.pgm");
  for (const std::vector<std::string>& whole : {std::vector<std::string>{"08.pgm", "09.pgm", "10.pgm"},
                                                {"a.pgm", "b.pgm", "d.pgm"},
                                                {"10.pgm", "20.pgm", "30.pgm", "31.pgm"},
                                                {"1403636579763555584.pgm", "1403636579763555585.pgm"}})
    EXPECT_EQ(notes_on(whole).find("missing"), std::string::npos) << notes_on(whole);
}

std::string png(int width, int height, int type) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", cv::Mat(height, width, type, cv::Scalar(7, 8, 9)), bytes);
  return {bytes.begin(), bytes.end()};
}

/// As RGB-D recordings are often unpacked: color and depth in one folder.
struct ColorAndDepth {
  Scratch scratch;
  ColorAndDepth() {
    for (int i = 0; i < 3; ++i) {
      scratch.write("frame-00" + std::to_string(i) + ".color.png", png(20, 16, CV_8UC3));
      scratch.write("frame-00" + std::to_string(i) + ".depth.png", png(20, 16, CV_16U));
    }
  }
  Recording read(const std::string& pattern) const {
    return read_recording(scratch.folder(), "auto", 25, pattern);
  }
};

TEST(ImageFolder, RefusesImagesOfTwoCameras) {
  const ColorAndDepth folder;
  const std::string text = message_of([&] { folder.read(""); });
  EXPECT_HAS(text,
             "the 6 images have names of 2 kinds: 3 frame-*.color.png (the first frame-000.color.png), 3 "
             "frame-*.depth.png");
  EXPECT_HAS(text, "recording.pattern = \"frame-*.color.png\"");
  const std::string all = message_of([&] { folder.read("*"); });
  EXPECT_HAS(
      all,
      "images differ: 3 of 20x16 px with 8 bits (the first frame-000.color.png), 3 of 20x16 px with 16 bits");
}

TEST(ImageFolder, SelectsByAPattern) {
  const ColorAndDepth folder;
  const Recording recording = folder.read("*.color.png");
  ASSERT_EQ(recording.frames.size(), 3u);
  EXPECT_EQ(recording.frames[2].image.filename(), "frame-002.color.png");
  EXPECT_HAS(recording.notes.back(), "3 images that do not match recording.pattern are ignored");
  EXPECT_HAS(message_of([&] { folder.read("*.jpg"); }), "matches none of its 6 images");
  const Scratch tum;
  tum.write("rgb.txt", "1 a.png\n");
  EXPECT_HAS(message_of([&] { read_recording(tum.folder(), "auto", 25, "*"); }),
             "does not apply to the format `tum`");
}

TEST(ImageFolder, SuggestsNoPatternThatMatchesBothCameras) {
  const Scratch scratch;
  for (const char* number : {"0", "1"})
    for (const char* kind : {".png", "_depth.png"})
      scratch.write(std::string(number) + kind, png(20, 16, CV_8U));
  const auto read = [&](const char* pattern) {
    return read_recording(scratch.folder(), "auto", 25, pattern);
  };
  for (const char* pattern : {"", "*.png"})
    EXPECT_HAS(message_of([&] { read(pattern); }), "put its images into their own folder") << pattern;
  EXPECT_EQ(read("[0-9].png").frames.size(), 2u);
  EXPECT_EQ(read("*").frames.size(), 4u);
}

TEST(ImageFolder, ReportsNamesThatDifferInACameraNumberOnly) {
  const Scratch scratch;
  for (const char* name : {"cam0_00.png", "cam0_01.png", "cam1_00.png", "cam1_01.png"})
    scratch.write(name, png(20, 16, CV_8U));
  const Recording recording = read_recording(scratch.folder(), "auto", 25, "");
  EXPECT_HAS(fmt::format("{}", fmt::join(recording.notes, "\n")),
             "the same numbers follow cam0_, cam1_: if these are cameras, select one, e.g. "
             "recording.pattern = \"cam0_*\"");
}

TEST(ImageFolder, ComparesImagesWithSimilarNames) {
  const Scratch scratch;
  for (int i = 0; i < 4; ++i)
    scratch.write("image" + std::to_string(i) + ".png", png(i % 2 ? 20 : 40, 16, CV_8U));
  EXPECT_HAS(message_of([&] { read_recording(scratch.folder(), "images", 25); }),
             "images differ: 2 of 40x16 px with 8 bits (the first image0.png), 2 of 20x16 px with 8 bits");
  for (int i = 0; i < 4; ++i)
    scratch.write("image" + std::to_string(i) + ".png", png(20, 16, i % 2 ? CV_8U : CV_8UC3));
  EXPECT_HAS(read_recording(scratch.folder(), "images", 25).notes.back(),
             "images of two kinds: 2 in color (the first image0.png), 2 gray (the first image1.png)");
}

TEST(ImageFolder, ASingleDifferentImageIsAWarning) {
  const Scratch scratch;
  for (int i = 0; i < 30; ++i) scratch.write("a" + std::to_string(i) + ".pgm", pgm(20, 16));
  scratch.write("target.pgm", pgm(30, 16));
  const Recording recording = read_recording(scratch.folder(), "images", 25);
  EXPECT_EQ(recording.frames.size(), 31u);
  std::string notes;
  for (const std::string& note : recording.notes) notes += note + "\n";
  EXPECT_HAS(notes, "names of 2 kinds: 30 a*.pgm (the first a0.pgm), 1 target.pgm");
  EXPECT_HAS(notes, "images differ: 30 of 20x16 px with 8 bits (the first a0.pgm), 1 of 30x16 px");
}

TEST(ImageHeader, IsParsed) {
  const auto is = [](const std::string& bytes, int width, int height, int channels, int bits) {
    const auto h = image_header(bytes);
    return h && h->width == width && h->height == height && h->channels == channels && h->bits == bits;
  };
  EXPECT_TRUE(is(png(300, 16, CV_8U), 300, 16, 1, 8));
  EXPECT_TRUE(is(png(20, 300, CV_16U), 20, 300, 1, 16));
  EXPECT_TRUE(is(png(20, 16, CV_8UC3), 20, 16, 3, 8));
  EXPECT_TRUE(is(png(20, 16, CV_8UC4), 20, 16, 3, 8));
  EXPECT_TRUE(is("P5 # made here\n20 16\n65535\n", 20, 16, 1, 16));
  EXPECT_TRUE(is("P6\n20 16\n255\n", 20, 16, 3, 8));
  for (const int type : {CV_8U, CV_8UC3}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", cv::Mat(300, 20, type, cv::Scalar(7, 8, 9)), bytes);
    EXPECT_TRUE(is({bytes.begin(), bytes.end()}, 20, 300, type == CV_8U ? 1 : 3, 8));
    for (std::size_t end = 0; end < bytes.size(); ++end)
      image_header({reinterpret_cast<char*>(bytes.data()), end});
  }
  for (const char* other : {"", "P5", "P5\n20\n", "BM..............", "text of no image"})
    EXPECT_FALSE(image_header(other)) << other;
}

TEST(ImageFolder, ListsTheFilesFoundInstead) {
  const Scratch scratch;
  scratch.write("frames/a.pgm", pgm(20, 16));
  EXPECT_HAS(message_of([&] { read_recording(scratch.folder(), "auto", 30); }),
             "no images in this folder; it has the folders frames");
  EXPECT_HAS(message_of([&] { read_recording(scratch.folder() / "none", "auto", 30); }), "is not a folder");
  EXPECT_HAS(message_of([&] { read_recording(scratch.folder(), "rosbag", 30); }),
             "recording.format = rosbag: must be");
}

TEST(TumRecording, ReadsImagesAndTruth) {
  const Scratch scratch;
  scratch.write("rgb.txt", "# color images\n1305031102.175304 rgb/a.png\n1305031102.211214 rgb/b.png\r\n");
  scratch.write(
      "groundtruth.txt",
      "# t tx ty tz qx qy qz qw\n1305031102.17 1 2 3 0 0 0.6 0.8\n1305031102.27 1.1 2 3 0 0 0.6 0.8\n");
  const Recording recording = read_recording(scratch.folder(), "auto", 30);
  EXPECT_EQ(recording.format, "tum");
  ASSERT_EQ(recording.frames.size(), 2u);
  EXPECT_EQ(recording.frames[1].image, scratch.folder() / "rgb/b.png");
  EXPECT_DOUBLE_EQ(recording.frames[0].t, 1305031102.175304);
  ASSERT_EQ(recording.truth.size(), 2u);
  EXPECT_EQ(recording.truth[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((recording.truth[0].world_from_camera - Eigen::Vector4d(0.8, 0, 0, 0.6)).norm(), 1e-12);

  ReplayWorld world({recorded_truth(share(recording))});
  const auto truth = world.move({}, at(1305031102.175304));
  ASSERT_TRUE(truth);
  EXPECT_EQ(truth->bodies[0].pose->position, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(truth->bodies[0].state[7], 1.0, 1e-5);  // 0.1 m in 0.1 s
  EXPECT_FALSE(world.move({}, at(1305031102.22))) << "50 ms from either pose";
  EXPECT_TRUE(world.move({}, at(1305031102.26)));
  EXPECT_FALSE(world.move({}, at(1305031103)));
}

TEST(TumRecording, RefusesInvalidTables) {
  const auto complaint = [](const std::string& rgb, const std::string& truth = "") {
    const Scratch scratch;
    scratch.write("rgb.txt", rgb);
    if (!truth.empty()) scratch.write("groundtruth.txt", truth);
    return message_of([&] { read_recording(scratch.folder(), "tum", 30); });
  };
  EXPECT_HAS(complaint("# nothing\n"), "rgb.txt: lists no images");
  EXPECT_HAS(complaint("# c\n1.5\n"), "rgb.txt:2: has 1 columns, column 2 is required");
  EXPECT_HAS(complaint("x a.png\n"), "rgb.txt:1: column 1 must be a number, and is `x`");
  EXPECT_HAS(complaint("nan a.png\n"), "column 1 must be a number");
  EXPECT_HAS(complaint("2 a.png\n1 b.png\n"), "rgb.txt:2: the stamps must increase, 1 does not");
  EXPECT_HAS(complaint("1 a.png\n", "1 0 0 0 0 0 0 0\n"),
             "groundtruth.txt:1: columns 5 to 8 must be a unit quaternion");
  EXPECT_HAS(complaint("1 a.png\n", "1 0 0 0 0 0 0\n"),
             "groundtruth.txt:1: has 7 columns, column 8 is required");
  EXPECT_HAS(complaint("1 a.png\n", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
             "groundtruth.txt:2: the stamps must not");
}

TEST(EurocRecording, TransformsTheTruthToTheCamera) {
  const Scratch scratch;
  scratch.write(
      "mav0/cam0/data.csv",
      "#timestamp [ns],filename\n1403636579763555584,1403636579763555584.png\n1403636579813555456,b.png\n");
  scratch.write(
      "mav0/state_groundtruth_estimate0/data.csv",
      "#timestamp, p_x, ...\n1403636579763555584,1,2,3,0.7071067811865476,0,0,0.7071067811865476,0,0,0\n");
  // the camera is 1 m along the body's x and rotated a quarter turn about z
  const std::string yaml =
      "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0.0, -1.0, 0.0, 1.0,\n         1.0, 0.0, "
      "0.0, 0.0,\n   0,0,1,0, 0,0,0,1]\n";
  const Recording body = read_recording(scratch.folder(), "auto", 30);
  EXPECT_EQ(body.format, "euroc");
  EXPECT_HAS(body.notes.back(), "the truth is that of the body");
  EXPECT_EQ(body.truth.at(0).position, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(body.frames.size(), 2u);
  EXPECT_EQ(body.frames[1].image, scratch.folder() / "mav0/cam0/data/b.png");
  EXPECT_NEAR(body.frames[1].t - body.frames[0].t, 0.049999872, 1e-6);

  scratch.write("mav0/cam0/sensor.yaml", yaml);
  const Recording camera = read_recording(scratch.folder() / "mav0", "euroc", 30);
  EXPECT_HAS(camera.notes.back(), "transformed to the camera");
  // world_from_body rotates a quarter turn about z: body x is world y
  EXPECT_LT((camera.truth.at(0).position - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(camera.truth.at(0).world_from_camera[3]), 1,
              1e-12);  // two quarter turns: half a turn about z

  scratch.write("mav0/cam0/data.csv", "12.5,a.png\n");
  EXPECT_HAS(message_of([&] { read_recording(scratch.folder(), "auto", 30); }),
             "data.csv:1: column 1 must be a stamp in whole nanoseconds, and is `12.5`");
}

TEST(EurocRecording, AcceptsStampsWithDecimals) {
  const Scratch scratch;
  scratch.write("cam0/data.csv", "1403636579763555584.0,a.png\n1403636579813555456.0,b.png\n");
  scratch.write("state_groundtruth_estimate0/data.csv",
                "#timestamp, p_x, ...\n1403636579763555584.000,1,2,3,1,0,0,0,0,0,0\n");
  const Recording recording = read_recording(scratch.folder(), "auto", 30);
  ASSERT_EQ(recording.frames.size(), 2u);
  EXPECT_NEAR(recording.frames[1].t - recording.frames[0].t, 0.049999872, 1e-6);
  ASSERT_EQ(recording.truth.size(), 1u);
  EXPECT_EQ(recording.truth[0].t, recording.frames[0].t);
}

SharedRecording three_images(const Scratch& scratch) {
  int k = 0;
  for (const char* name : {"a0.pgm", "a1.pgm", "a2.pgm"}) scratch.write(name, pgm(20, 16, k++));
  return share(read_recording(scratch.folder(), "images", 10));
}

TEST(RecordedImages, EndAtTheEndOfTheRecordingOrTheDuration) {
  const Scratch scratch;
  const SharedRecording recording = three_images(scratch);
  ReplayClock whole(frame_times(*recording, 100)), part(frame_times(*recording, 0.2));
  EXPECT_EQ(whole.expected_frames(), 3);
  EXPECT_EQ(part.expected_frames(), 2);
  const Tick first = whole.next(), second = whole.next();
  EXPECT_EQ(first.frame, 0);
  EXPECT_EQ(first.dt, 0);
  EXPECT_EQ(second.frame, 1);
  EXPECT_DOUBLE_EQ(second.t, 0.1);
  EXPECT_DOUBLE_EQ(second.dt, 0.1);
  EXPECT_TRUE(whole.next());
  EXPECT_FALSE(whole.next());
  EXPECT_FALSE(whole.next());
  EXPECT_FALSE(ReplayWorld({recorded_truth(recording)}).move({}, first));
}

TEST(RecordedImages, ReturnsTheImagesInOrder) {
  const Scratch scratch;
  SensorSet sensor(sensors_of_body(std::make_unique<RecordedImages>(three_images(scratch), 20, 16)));
  for (int k : {0, 1, 2, 0}) {
    const Observation observation = sensor.measure(std::nullopt, {k, 0, 0});
    ASSERT_TRUE(observation.bodies.at(0).images.at(0));
    EXPECT_EQ((*observation.bodies[0].images.at(0))(0, 0), k);
    EXPECT_EQ((*observation.bodies[0].images.at(0))(5, 4), k + 3 * 5 + 7 * 4);
  }
  EXPECT_HAS(message_of<RecordError>([&] {
               sensor.measure(std::nullopt, {3, 0, 0});
             }),
             "frame 3 requested, the recording has 3");
}

TEST(RecordedImages, AWrongFirstImageIsAnInputError) {
  const Scratch scratch;
  const SharedRecording recording = three_images(scratch);
  const std::string text = message_of([&] { RecordedImages(recording, 320, 240); });
  EXPECT_HAS(text, "a0.pgm: frame 0 is 20x16 px");
  EXPECT_HAS(text, "expect 320x240");
  scratch.write("a0.pgm", pgm(20, 16).substr(0, 100));
  EXPECT_HAS(message_of([&] { RecordedImages(recording, 20, 16); }), "a0.pgm: the file is truncated");
}

TEST(RecordedImages, ALaterFailureIsARuntimeError) {
  const Scratch scratch;
  SensorSet sensor(sensors_of_body(std::make_unique<RecordedImages>(three_images(scratch), 20, 16)));
  const auto complaint = [&] {
    return message_of<RecordError>([&] { sensor.measure(std::nullopt, {1, 0.1, 0.1}); });
  };
  scratch.write("a1.pgm", pgm(21, 16));
  EXPECT_HAS(complaint(), "a1.pgm: frame 1 is 21x16 px, camera.width_px and camera.height_px expect 20x16");
  scratch.write("a1.pgm", "");
  EXPECT_HAS(complaint(), "frame 1 of 3 cannot be read");
  EXPECT_HAS(complaint(), "a1.pgm: the file is empty");
  std::filesystem::remove(scratch.folder() / "a1.pgm");
  EXPECT_HAS(complaint(), "a1.pgm: cannot be read: No such file");
}

// Decoders silently fill the missing part of an image with gray.
TEST(ReadImage, RefusesEveryTruncation) {
  const Scratch scratch;
  cv::Mat noise(48, 64, CV_8U);
  cv::randu(noise, 0, 255);
  for (const char* ending : {".pgm", ".jpg", ".png", ".bmp"}) {
    std::vector<unsigned char> bytes;
    ASSERT_TRUE(cv::imencode(ending, noise, bytes));
    const std::string whole(bytes.begin(), bytes.end());
    const Image image = read_image(scratch.write(std::string("whole") + ending, whole));
    EXPECT_EQ(image.width(), 64);
    EXPECT_EQ(image.height(), 48);
    if (ending != std::string(".jpg")) {
      EXPECT_EQ(image(13, 7), noise.at<unsigned char>(7, 13));
    }
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
      const auto file = scratch.write(std::string("part") + ending, whole.substr(0, size));
      EXPECT_HAS(message_of<std::runtime_error>([&] { read_image(file); }), "part") << ending << " " << size;
    }
    const auto last = scratch.write(std::string("part") + ending, whole.substr(0, whole.size() - 1));
    EXPECT_HAS(message_of<std::runtime_error>([&] { read_image(last); }), "truncated") << ending;
  }
}

TEST(ReadImage, AcceptsTextPgmWithComments) {
  const Scratch scratch;
  const Image image = read_image(scratch.write("t.pgm", "P2\n# by hand\n3 2\n255\n1 2 3\n4 5 6\n"));
  EXPECT_EQ(image(2, 1), 6);
  EXPECT_HAS(message_of<std::runtime_error>(
                 [&] { read_image(scratch.write("t.pgm", "P2\n3 2\n255\n1 2 3\n4 5\n")); }),
             "truncated");
  EXPECT_HAS(
      message_of<std::runtime_error>([&] { read_image(scratch.write("t.pgm", "P5\n99999999999 2\n255\n")); }),
      "header");
  EXPECT_HAS(message_of<std::runtime_error>([&] { read_image(scratch.write("t.png", "no image at all")); }),
             "t.png: is not an image");
}

class DataFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const char* value = std::getenv("INCOGNITA_DATA")) before_ = value;
    unsetenv("INCOGNITA_DATA");
    std::filesystem::current_path(scratch_.folder());
  }
  void TearDown() override {
    std::filesystem::current_path(here_);
    if (!before_.empty()) setenv("INCOGNITA_DATA", before_.c_str(), 1);
  }
  Scratch scratch_;
  std::string before_;
  std::filesystem::path here_ = std::filesystem::current_path();
};

TEST_F(DataFolder, IsSearchedInOrder) {
  scratch_.write("data/mine/a.pgm", pgm(20, 16));
  scratch_.write("project/data/far/a.pgm", pgm(20, 16));
  const std::filesystem::path scenario = scratch_.write("project/scenarios/s.toml", "");
  EXPECT_EQ(find_data("mine", "", "x"), std::filesystem::path("data/mine"));
  EXPECT_EQ(find_data("far", scenario, "x"), scratch_.folder() / "project/data/far");
  EXPECT_EQ(find_data((scratch_.folder() / "data").string(), "", "x"), scratch_.folder() / "data");
  setenv("INCOGNITA_DATA", (scratch_.folder() / "project/data").c_str(), 1);
  EXPECT_EQ(find_data("far", "", "x"), scratch_.folder() / "project/data/far");
  EXPECT_HAS(message_of([&] { find_data("mine", scenario, "s.toml:3: recording.folder"); }),
             "s.toml:3: recording.folder: mine is not in the data folder");
  const std::string text = message_of([&] { find_data("mine", scenario, "x"); });
  EXPECT_HAS(text, "INCOGNITA_DATA is set, so that only this folder, and that of the scenario, is searched");
  EXPECT_EQ(text.find("Put it under data/"), std::string::npos) << text;
  unsetenv("INCOGNITA_DATA");
  EXPECT_HAS(message_of([&] { find_data("none", scenario, "x"); }),
             "Put it under data/, or set INCOGNITA_DATA");
}

TEST_F(DataFolder, AMissingRecordingIsReportedWithItsPublisher) {
  const LoadedScenario davison = load_scenario("davison");
  const std::string text = message_of([&] { read_recording(davison); });
  EXPECT_HAS(text, "davison.toml:");
  EXPECT_HAS(text, "recording.folder: monoslam_testseq/frames is not in the data folder");
  EXPECT_HAS(text, "www.doc.ic.ac.uk/~ajd/Scene/Release/testseqmonoslam.tar.gz");
  EXPECT_HAS(text, "A. J. Davison");
  EXPECT_HAS(text, "SHA-256");
  EXPECT_HAS(text, "INCOGNITA_DATA");
}

}  // namespace
}  // namespace incognita
