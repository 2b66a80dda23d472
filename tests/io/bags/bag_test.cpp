// Bags that were written by the libraries of the field: their topics and the content of their messages.
#include "incognita/io/bags/bag.hpp"

#include <gtest/gtest.h>

#include "incognita/io/bags/messages.hpp"
#include "tests/io/bags/bag_scene.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using bags::Bag;
using bags::BagTopic;
using testing::contents;
using testing::message_of;
using testing::Scratch;
using testing::written_bag;

class WrittenBag : public ::testing::TestWithParam<std::string> {
 protected:
  const Bag bag_{written_bag(GetParam())};

  const BagTopic& topic(const std::string& name) const { return bag_.topics().at(name); }

  /// Message number `i` of the topic, read by `read`.
  template <class Read>
  auto message(const std::string& name, std::size_t i, Read read) {
    content_ = bag_.content(topic(name).messages.at(i));
    const bool is_cdr = topic(name).encoding == "cdr";
    bags::MessageCursor cursor(content_, is_cdr ? bags::Serialization::cdr : bags::Serialization::ros1);
    return read(cursor);
  }

  std::string content_;
};

TEST_P(WrittenBag, HasItsTopics) {
  EXPECT_EQ(bag_.topics().size(), 12u);
  EXPECT_TRUE(bag_.damage().empty());
  const std::map<std::string, std::pair<std::string, std::size_t>> expected{
      {"/cam/image_raw", {"sensor_msgs/Image", 12}},
      {"/cam/image_raw/compressed", {"sensor_msgs/CompressedImage", 6}},
      {"/cam/camera_info", {"sensor_msgs/CameraInfo", 12}},
      {"/color/image_color", {"sensor_msgs/Image", 6}},
      {"/depth/image", {"sensor_msgs/Image", 24}},
      {"/vicon/body", {"geometry_msgs/TransformStamped", 12}},
      {"/tf", {"tf2_msgs/TFMessage", 12}},
      {"/tf_static", {"tf2_msgs/TFMessage", 2}},
      {"/odom", {"nav_msgs/Odometry", 12}},
      {"/pose", {"geometry_msgs/PoseStamped", 12}},
      {"/pose_cov", {"geometry_msgs/PoseWithCovarianceStamped", 12}},
      {"/chatter", {"std_msgs/String", 12}}};
  for (const auto& [name, what] : expected) {
    ASSERT_TRUE(bag_.topics().contains(name)) << name;
    EXPECT_EQ(topic(name).type, what.first);
    EXPECT_EQ(topic(name).messages.size(), what.second) << name;
    EXPECT_EQ(topic(name).encoding, GetParam().ends_with(".bag") ? "ros1" : "cdr");
  }
}

TEST_P(WrittenBag, HasItsImages) {
  for (int k = 0; k < testing::bag_instants; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto image = message("/cam/image_raw", i, bags::read_image);
    EXPECT_EQ(image.header.stamp_ns, testing::bag_time_ns(k));
    EXPECT_EQ(static_cast<std::int64_t>(topic("/cam/image_raw").messages[i].place.time_ns),
              testing::bag_time_ns(k) + testing::bag_delay_ns);
    EXPECT_EQ(image.header.frame, "cam");
    EXPECT_EQ(image.encoding, "mono8");
    ASSERT_EQ(image.data.size(), 32u * 24u);
    EXPECT_EQ(
        std::string_view(reinterpret_cast<const char*>(testing::bag_image(k).row(0)), image.data.size()),
        image.data);
  }
  const auto compressed = message("/cam/image_raw/compressed", 3, bags::read_compressed_image);
  EXPECT_TRUE(compressed.format.starts_with("mono8; png compressed"));
  EXPECT_TRUE(compressed.data.starts_with("\x89PNG"));
}

TEST_P(WrittenBag, HasItsCamera) {
  const auto info = message("/cam/camera_info", 5, bags::read_camera_info);
  EXPECT_EQ(info.width, 32u);
  EXPECT_EQ(info.height, 24u);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_EQ(info.d, (std::vector<double>{-0.1, 0.01, 0.001, -0.002, 0}));
  EXPECT_EQ(info.k, (std::array<double, 9>{40, 0, 15.5, 0, 41, 11.25, 0, 0, 1}));
  EXPECT_EQ(info.p, (std::array<double, 12>{39, 0, 15, 0, 0, 38, 11, 0, 0, 0, 1, 0}));
  EXPECT_EQ(info.binning_x + info.binning_y + info.roi_x + info.roi_y + info.roi_height + info.roi_width, 0u);
}

TEST_P(WrittenBag, HasItsPoses) {
  for (int k = 0; k < testing::bag_instants; ++k) {
    const auto i = static_cast<std::size_t>(k);
    std::vector<bags::PoseMessage> poses{
        message("/vicon/body", i, bags::read_transform), message("/odom", i, bags::read_odometry),
        message("/pose", i, bags::read_pose), message("/pose_cov", i, bags::read_pose),
        message("/tf", i, bags::read_transforms).at(0)};
    for (const bags::PoseMessage& pose : poses) {
      EXPECT_EQ(pose.header.frame, "world");
      EXPECT_EQ(pose.header.stamp_ns, testing::bag_time_ns(k));
      EXPECT_EQ(pose.position, Eigen::Vector3d(0.1 * k, 1, 2));
      EXPECT_NEAR((pose.rotation - Eigen::Vector4d(std::cos(0.05 * k), 0, 0, std::sin(0.05 * k))).norm(), 0,
                  1e-15);
    }
    EXPECT_EQ(poses[0].child, "body");
    EXPECT_EQ(poses[1].child, "body");
    EXPECT_EQ(poses[2].child, "");
  }
  const auto fixed = message("/tf_static", 0, bags::read_transforms);
  ASSERT_EQ(fixed.size(), 1u);
  EXPECT_EQ(fixed[0].header.frame + " > " + fixed[0].child, "body > cam");
  EXPECT_EQ(fixed[0].rotation, Eigen::Vector4d(0.5, -0.5, 0.5, -0.5));
}

TEST_P(WrittenBag, GivesTheFirstBytesOfAMessage) {
  const bags::BagMessage& image = topic("/cam/image_raw").messages.at(7);
  EXPECT_EQ(bag_.content(image, 20), bag_.content(image).substr(0, 20));
}

std::string name_of(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  name[name.find('.')] = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Bags, WrittenBag, ::testing::ValuesIn(testing::names_of_bags()), name_of);

const std::string metadata = "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n";

void copy_bags(const Scratch& scratch, const std::vector<std::string>& names) {
  for (const std::string& name : names) scratch.write(name, contents(written_bag(name)));
}

TEST(BagFolder, OfSeveralFilesIsOneBag) {
  const Scratch scratch;
  copy_bags(scratch, {"split_0.mcap", "split_1.mcap"});
  const auto expect_whole = [&] {
    const Bag bag(scratch.folder());
    EXPECT_TRUE(bag.damage().empty());
    const auto& messages = bag.topics().at("/cam/image_raw").messages;
    ASSERT_EQ(messages.size(), 12u);
    for (int k = 0; k < 12; ++k)
      EXPECT_EQ(static_cast<std::int64_t>(messages[static_cast<std::size_t>(k)].place.time_ns),
                testing::bag_time_ns(k) + testing::bag_delay_ns);
  };
  expect_whole();  // without metadata.yaml: the recorder was killed
  scratch.write("metadata.yaml",
                metadata + "  relative_file_paths:\n    - split_1.mcap\n    - split_0.mcap\n");
  expect_whole();
}

TEST(BagFolder, SaysWhichFileIsMissing) {
  const Scratch scratch;
  copy_bags(scratch, {"split_0.mcap"});
  scratch.write("metadata.yaml",
                metadata + "  relative_file_paths:\n    - split_0.mcap\n    - split_1.mcap\n");
  const Bag bag(scratch.folder());
  ASSERT_EQ(bag.damage().size(), 1u);
  EXPECT_HAS(bag.damage()[0], "split_1.mcap: is listed in metadata.yaml and is not there");
  EXPECT_EQ(bag.topics().at("/cam/image_raw").messages.size(), 6u);
}

TEST(BagFolder, SaysWhichFileCannotBeRead) {
  const Scratch scratch;
  copy_bags(scratch, {"split_0.mcap"});
  scratch.write("split_1.mcap", "no bag");
  const Bag bag(scratch.folder());
  ASSERT_EQ(bag.damage().size(), 1u);
  EXPECT_HAS(bag.damage()[0], "split_1.mcap: at byte 0: neither an MCAP file nor a ROS 1 bag");
}

TEST(BagFolder, RefusesWhatIsNotReadWithTheRemedy) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& yaml) {
    scratch.write("metadata.yaml", yaml);
    return message_of([&] { Bag bag(scratch.folder()); });
  };
  copy_bags(scratch, {"split_0.mcap"});
  EXPECT_HAS(refusal("rosbag2_bagfile_information:\n  storage_identifier: sqlite3\n"), "ros2 bag convert");
  EXPECT_HAS(refusal(metadata + "  compression_mode: FILE\n"), "`zstd -d`");
  EXPECT_HAS(refusal(metadata + "  compression_mode: message\n"), "ros2 bag convert");
  EXPECT_HAS(refusal("a: [1\n"), "metadata.yaml:2: is not YAML");
  EXPECT_HAS(refusal("a: 1\n"), "has no rosbag2_bagfile_information");
  EXPECT_EQ(refusal(metadata + "  compression_mode: \"\"\n"), "(none)");
  EXPECT_HAS(message_of([&] { Bag bag(scratch.write("a/x_0.db3", "SQLite")); }), "ros2 bag convert");
  EXPECT_HAS(message_of([&] { Bag bag(scratch / "a"); }), "ros2 bag convert");
  scratch.write("b/notes.txt", "");
  EXPECT_HAS(message_of([&] { Bag bag(scratch / "b"); }), "there is no MCAP file in this folder");
}

TEST(BagFile, RefusesOtherFiles) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& bytes) {
    return message_of([&, path = scratch.write("other.bag", bytes)] { Bag bag(path); });
  };
  EXPECT_HAS(refusal(""), "other.bag: at byte 0: neither an MCAP file nor a ROS 1 bag");
  EXPECT_HAS(refusal("#ROSBAG V1.2\n"), "rosbag fix");
  EXPECT_HAS(refusal("#ROSBAG V2.0\n"), "no message before it");
  EXPECT_HAS(refusal("#ROSBAG V2.0\n" + std::string(100, '\xFF')),
             "at byte 13: a record of 4294967295 bytes is cut off");
  EXPECT_HAS(message_of([&] { Bag bag(scratch / "none.bag"); }), "none.bag: cannot be read");
}

}  // namespace
}  // namespace incognita
