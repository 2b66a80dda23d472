// Recordings from bags that were written by the libraries of the field.
#include <gtest/gtest.h>

#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/math/quaternion.hpp"
#include "tests/io/bags/bag_scene.hpp"
#include "tests/io/heard_reading.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::message_of;
using testing::Scratch;
using testing::written_bag;

std::string notes_of(const Recording& recording) {
  std::string all;
  for (const std::string& note : recording.notes) all += note + "\n";
  return all;
}

Recording read(const std::string& name, const BagTopics& topics = {}) {
  return read_recording(written_bag(name), "auto", 30, "", topics);
}

/// Pose of `cam` at instant k: that of `body`, and `cam` in `body`.
void expect_camera_pose(const RecordedPose& pose, int k) {
  const double c = std::cos(0.1 * k), s = std::sin(0.1 * k);
  const Eigen::Vector3d expected(0.1 * k + c * 0.1 - s * 0.2, 1 + s * 0.1 + c * 0.2, 2.3);
  EXPECT_EQ(pose.t, static_cast<double>(testing::bag_time_ns(k)) / 1e9);
  EXPECT_NEAR((pose.position - expected).norm(), 0, 1e-12);
  // The optical axis of `cam` is the x axis of `body`
  const Eigen::Vector3d axis = rotation_matrix(pose.world_from_camera) * Eigen::Vector3d(0, 0, 1);
  EXPECT_NEAR((axis - Eigen::Vector3d(c, s, 0)).norm(), 0, 1e-12);
}

TEST(ReadingProgress, IsToldOfTheMessagesOfABagAndOfItsBytesWhereItHasNoIndex) {
  for (const auto& [name, expected] :
       {std::pair{"zstd.mcap", "messages of zstd.mcap"},
        {"bz2.bag", "messages of bz2.bag"},
        {"without_index.mcap", "bytes of without_index.mcap, messages of without_index.mcap"},
        {"unindexed.bag", "bytes of unindexed.bag, messages of unindexed.bag"}}) {
    testing::HeardReading listener;
    read(name);
    EXPECT_EQ(listener.in_words(), expected);
    const auto& [reading, done, ended] = listener.heard.back();
    EXPECT_EQ(done.back(), reading.total) << name;
    if (listener.heard.size() < 2) continue;
    EXPECT_EQ(listener.heard.front().reading.total, std::filesystem::file_size(written_bag(name)));
    EXPECT_GT(listener.heard.front().done.back(), listener.heard.front().reading.total / 2) << name;
  }
}

TEST(ReadingProgress, EndsWhereTheBagIsDamaged) {
  const Scratch scratch;
  const std::string bytes = contents(written_bag("unindexed.bag"));
  const std::filesystem::path cut = scratch.write("cut.bag", bytes.substr(0, bytes.size() * 2 / 3));
  testing::HeardReading listener;
  read_recording(cut, "bag", 30);
  EXPECT_EQ(listener.in_words(), "bytes of cut.bag, messages of cut.bag");
}

TEST(ReadingProgress, IsHeardByTheInnermostListener) {
  testing::HeardReading outer;
  {
    testing::HeardReading inner;
    read("plain.bag");
    EXPECT_EQ(inner.heard.size(), 1u);
  }
  EXPECT_TRUE(outer.heard.empty());
  read("plain.bag");
  EXPECT_EQ(outer.heard.size(), 1u);
}

class BagRecording : public ::testing::TestWithParam<std::string> {};

TEST_P(BagRecording, HasFramesTruthAndCamera) {
  const Recording recording = read(GetParam());
  EXPECT_EQ(recording.format, "bag");
  ASSERT_EQ(recording.frames.size(), 12u);
  ASSERT_EQ(recording.truth.size(), 12u);
  for (int k = 0; k < 12; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(recording.frames[i].t, static_cast<double>(testing::bag_time_ns(k)) / 1e9);
    EXPECT_EQ(*recording.images->read(i), testing::bag_image(k)) << k;
    expect_camera_pose(recording.truth[i], k);
  }
  EXPECT_EQ(*recording.images->read(2), testing::bag_image(2)) << "any order is allowed";
  ASSERT_TRUE(recording.camera);
  EXPECT_EQ(recording.camera->unfit, "");
  EXPECT_EQ(recording.camera->camera.fv_px, 41);
  EXPECT_EQ(recording.camera->camera.v0_px, 11.25);
  EXPECT_EQ(std::get<PinholeLens>(recording.camera->camera.model).p2, -0.002);
}

TEST_P(BagRecording, SaysWhatWasChosen) {
  const std::string notes = notes_of(read(GetParam()));
  EXPECT_HAS(notes, "detected format `bag`");
  EXPECT_HAS(notes,
             "images of /cam/image_raw (sensor_msgs/Image, 12); recording.image_topic may name another: ");
  EXPECT_HAS(notes, "/depth/image (sensor_msgs/Image, 24)");
  EXPECT_HAS(notes, "truth of /vicon/body (geometry_msgs/TransformStamped, 12), by its name");
  EXPECT_HAS(notes, "transformed to `cam`, the frame of the images, by TF");
}

std::string name_of_bag(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  name[name.find('.')] = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Bags, BagRecording, ::testing::ValuesIn(testing::names_of_bags()), name_of_bag);

class BagOfEither : public ::testing::TestWithParam<std::string> {};

TEST_P(BagOfEither, TakesTheTopicsThatAreNamed) {
  const Recording compressed = read(GetParam(), {"/cam/image_raw/compressed", "/tf"});
  ASSERT_EQ(compressed.frames.size(), 6u);
  EXPECT_EQ(*compressed.images->read(5), testing::bag_image(5));
  EXPECT_TRUE(compressed.camera) << "the camera of a compressed image is that of the image";
  EXPECT_HAS(notes_of(compressed), "by TF, world > body > cam: of 6 of 6 images");
  ASSERT_EQ(compressed.truth.size(), 6u);
  for (int k = 0; k < 6; ++k) expect_camera_pose(compressed.truth[static_cast<std::size_t>(k)], k);

  const Recording color = read(GetParam(), {"color/image_color", "odom"});  // without slashes
  EXPECT_EQ((*color.images->read(4))(1, 1), 87) << "0.114 blue + 0.587 green + 0.299 red";
  EXPECT_FALSE(color.camera);
  EXPECT_HAS(notes_of(color), "there is no CameraInfo beside /color/image_color");
  ASSERT_EQ(color.truth.size(), 12u);
  for (int k = 0; k < 12; ++k) expect_camera_pose(color.truth[static_cast<std::size_t>(k)], k);
}

TEST_P(BagOfEither, SaysThatAPoseWithoutAChildIsTakenForThatOfTheCamera) {
  for (const std::string topic : {"/pose", "/pose_cov"}) {
    const Recording recording = read(GetParam(), {"", topic});
    EXPECT_HAS(notes_of(recording), "the truth is taken for the pose of the camera's optical axes");
    ASSERT_EQ(recording.truth.size(), 12u);
    EXPECT_EQ(recording.truth[3].position, Eigen::Vector3d(0.1 * 3, 1, 2));
  }
}

TEST_P(BagOfEither, RefusesTopicsThatItDoesNotHave) {
  EXPECT_HAS(
      message_of([] {
        read(GetParam(), {"/cam1/image_raw", ""});
      }),
      GetParam() +
          ": recording.image_topic = \"/cam1/image_raw\": there is no such topic; image topics: /cam/image_raw (");
  EXPECT_HAS(message_of([] {
               read(GetParam(), {"/odom", ""});
             }),
             "\"/odom\": is /odom (nav_msgs/Odometry, 12), and no images that can be read");
  EXPECT_HAS(message_of([] {
               read(GetParam(), {"", "/vicon"});
             }),
             "recording.truth_topic = \"/vicon\": there is no such topic; topics of poses: /odom (");
  EXPECT_HAS(message_of([] { read(GetParam(), {"", "/depth/image"}); }), "and no poses that can be read");
}

TEST_P(BagOfEither, RefusesAnEncodingThatIsNotReadWithFileAndByte) {
  const Recording depth = read(GetParam(), {"/depth/image", ""});
  EXPECT_EQ(depth.frames.size(), 12u) << "two of each instant have the same stamp";
  EXPECT_HAS(notes_of(depth), "12 images are not used: they have the time stamp of another");
  const std::string why = message_of<std::runtime_error>([&] { depth.images->read(3); });
  EXPECT_HAS(why, GetParam() + ": at byte ");
  EXPECT_HAS(why, "encoding `16UC1` is not read");
}

INSTANTIATE_TEST_SUITE_P(Bags, BagOfEither, ::testing::Values("plain.mcap", "plain.bag"), name_of_bag);

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// A bag without checksums of its messages, changed.
Recording changed(const Scratch& scratch, const std::string& from, const std::string& to,
                  const BagTopics& topics = {}) {
  const std::string bytes = contents(written_bag("unchunked.mcap"));
  return read_recording(scratch.write("x.mcap", replaced(bytes, from, to)), "auto", 30, "", topics);
}

TEST(BagTruth, IsThatOfTheTransformsWithoutATopicThatIsNamedSo) {
  const Scratch scratch;
  const Recording recording = changed(scratch, "/vicon/body", "/camera/bod");
  ASSERT_EQ(recording.truth.size(), 12u);
  for (int k = 0; k < 12; ++k) expect_camera_pose(recording.truth[static_cast<std::size_t>(k)], k);
  EXPECT_HAS(notes_of(recording),
             "the truth is the pose of the camera by TF, world > body > cam: of 12 of 12 images");
}

TEST(BagTruth, IsNeverThatOfOdometryUnlessNamed) {
  const Scratch scratch;
  const std::string bytes = replaced(contents(written_bag("unchunked.mcap")), "/vicon/body", "/camera/bod");
  const auto bag =
      scratch.write("x.mcap", replaced(bytes, std::string("body\0", 5), std::string("odom\0", 5)));
  const Recording guessed = read_recording(bag, "auto", 30);
  EXPECT_TRUE(guessed.truth.empty());
  EXPECT_HAS(notes_of(guessed), "the truth is unknown: recording.truth_topic may name ");
  EXPECT_HAS(notes_of(guessed), "/odom (nav_msgs/Odometry)");
  EXPECT_HAS(notes_of(guessed), "/tf (world > odom > cam)");
  EXPECT_EQ(read_recording(bag, "auto", 30, "", {"", "/tf"}).truth.size(), 12u);
}

TEST(BagTruth, ThatCannotBeTransformedStaysAndIsSaid) {
  const Scratch scratch;
  const Recording without = changed(scratch, "tf2_msgs/msg/TFMessage", "tf3_msgs/msg/TFMessage");
  EXPECT_HAS(notes_of(without),
             "the truth is that of `body`, not of the camera: TF has no fixed transform from there to `cam`");
  EXPECT_EQ(without.truth.at(2).position, Eigen::Vector3d(0.2, 1, 2));
}

TEST(BagTimes, AreThoseOfTheRecorderWithoutStamps) {
  const Scratch scratch;
  std::string bytes = contents(written_bag("unchunked.mcap"));
  for (const char last : {'\0', '\1'}) {  // 1600000000 s and the second after it, then nanoseconds
    const std::string seconds = last + std::string("\x10\x5E\x5F");
    for (std::size_t at = bytes.find(seconds); at != std::string::npos; at = bytes.find(seconds, at + 1))
      bytes.replace(at, 8, std::string(8, '\0'));
  }
  const Recording recording = read_recording(scratch.write("x.mcap", bytes), "auto", 30);
  EXPECT_HAS(notes_of(recording),
             "the images have no time stamps: they have the times of the recorder, and so has the truth");
  ASSERT_EQ(recording.frames.size(), 12u);
  ASSERT_EQ(recording.truth.size(), 12u);
  for (int k = 0; k < 12; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(recording.frames[i].t,
              static_cast<double>(testing::bag_time_ns(k) + testing::bag_delay_ns) / 1e9);
    EXPECT_EQ(recording.truth[i].t, recording.frames[i].t);
  }
}

/// Only the first images lack a stamp, as of a driver that starts: 1600000001 s are those of images 10 and 11.
TEST(BagTimes, OfImagesWithoutAStampAmongOthersAreNotGuessed) {
  const Scratch scratch;
  std::string bytes = contents(written_bag("unchunked.mcap"));
  const std::string seconds("\0\x10\x5E\x5F", 4);
  for (std::size_t at = bytes.find(seconds); at != std::string::npos; at = bytes.find(seconds, at + 1))
    bytes.replace(at, 8, std::string(8, '\0'));
  const Recording recording = read_recording(scratch.write("x.mcap", bytes), "auto", 30);
  EXPECT_EQ(recording.frames.size(), 2u);
  EXPECT_EQ(*recording.images->read(0), testing::bag_image(10));
  EXPECT_HAS(notes_of(recording), "10 images are not used: they have no time stamp");
}

/// The text that a scenario needs beside the bag.
LoadedScenario scenario_of(const std::filesystem::path& bag, const std::string& more = "") {
  const Scratch scratch;
  const std::string start =
      "[start]\nfrom = \"free\"\n[landmark_initialization]\nselection = \"random-box\"\n"
      "box_width_px = 20\nbox_height_px = 16\n";  // smaller than the images
  const auto file =
      scratch.write("s.toml", start + "[world]\ntype = \"recording\"\n[recording]\nfolder = \"" +
                                  bag.string() + "\"\n" + more);
  return load_scenario(file.string());
}

TEST(BagCamera, IsTakenByAScenarioWithoutOne) {
  for (const std::string name : {"plain.mcap", "lz4.bag"}) {
    const LoadedScenario loaded = scenario_of(written_bag(name));
    EXPECT_EQ(loaded.scenario.camera.fu_px, 40);
    EXPECT_EQ(loaded.scenario.camera.width_px, 32);
    EXPECT_HAS(compare_camera(loaded, read_recording(loaded)),
               "the camera is taken from " + written_bag(name).string() + ": /cam/camera_info");
  }
}

TEST(BagCamera, IsComparedWithThatOfAScenario) {
  const std::string camera =
      "[camera]\nmodel = \"pinhole\"\nwidth_px = 32\nheight_px = 24\nu0_px = 15.5\nv0_px = 11.25\nfu_px = 44\n";
  const LoadedScenario loaded = scenario_of(written_bag("plain.mcap"), camera);
  EXPECT_HAS(message_of([&] { compare_camera(loaded, read_recording(loaded)); }), "camera.fu_px = 44");
}

TEST(BagCamera, FollowsTheTopicThatTheScenarioNames) {
  const LoadedScenario loaded = scenario_of(
      written_bag("plain.bag"), "image_topic = \"/color/image_color\"\ntruth_topic = \"/odom\"\n");
  EXPECT_NE(loaded.scenario.camera.fu_px, 40);
  EXPECT_EQ(read_recording(loaded).frames.size(), 6u);
}

TEST(BagRecordingFolder, IsDetectedAndHasNoTopicsInOtherFormats) {
  const Scratch scratch;
  scratch.write("bag/x_0.mcap", contents(written_bag("split_0.mcap")));
  EXPECT_EQ(read_recording(scratch / "bag", "auto", 30).frames.size(), 6u);
  scratch.write("images/1.pgm", testing::pgm(4, 4));
  EXPECT_HAS(message_of([&] {
               read_recording(scratch / "images", "images", 30, "", {"/a", ""});
             }),
             "do not apply to the format `images`, which has no topics");
}

}  // namespace
}  // namespace incognita
