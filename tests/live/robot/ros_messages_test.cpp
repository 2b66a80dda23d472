// The messages of ROS as rosbridge writes them, of both generations.
#include "incognita/live/robot/ros_messages.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "incognita/record/files/image_text.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using Json = nlohmann::json;

TEST(RosMessages, ReadsTheStampsOfBothGenerations) {
  const std::string body = R"("frame_id": "c"}, "format": "jpeg", "data": "AAEC"})";
  const auto one = ros::compressed_image(
      R"({"header": {"seq": 3, "stamp": {"secs": 1700000000, "nsecs": 123456789}, )" + body);
  const auto two =
      ros::compressed_image(R"({"header": {"stamp": {"sec": 1700000000, "nanosec": 123456789}, )" + body);
  EXPECT_EQ(one.header.stamp_ns, 1700000000123456789);
  EXPECT_EQ(two.header.stamp_ns, one.header.stamp_ns);
  EXPECT_EQ(one.data, std::string("\x00\x01\x02", 3));
}

TEST(RosMessages, BytesMayBeAListOfNumbers) {
  const std::string begin = R"({"header": {"stamp": {"sec": 1, "nanosec": 0}}, "format": "png", "data": )";
  EXPECT_EQ(ros::compressed_image(begin + "[0, 255]}").data, std::string("\x00\xff", 2));
  EXPECT_THROW(ros::compressed_image(begin + "[0, 256]}"), InputError);
  EXPECT_THROW(ros::compressed_image(begin + "\"AA\"}"), InputError);
  EXPECT_THROW(ros::compressed_image(begin + "7}"), InputError);
}

TEST(RosMessages, WritesTheNamesOfItsGeneration) {
  const ros::CompressedImage image{{1500000000000000001, "camera"}, "jpeg", std::string("\xff\xd8\x00", 3)};
  const Json one = Json::parse(ros::to_json(image, 1)), two = Json::parse(ros::to_json(image, 2));
  EXPECT_EQ(one["header"]["stamp"], Json::parse(R"({"secs": 1500000000, "nsecs": 1})"));
  EXPECT_EQ(two["header"]["stamp"], Json::parse(R"({"sec": 1500000000, "nanosec": 1})"));
  EXPECT_FALSE(two["header"].contains("seq")) << "rosbridge of ROS 2 refuses fields that it does not know";
  EXPECT_EQ(from_base64(two["data"].get<std::string>()), image.data);
  ros::CameraInfo info;
  info.width = 320, info.height = 240, info.K = {195, 0, 159.5, 0, 196, 119.5, 0, 0, 1},
  info.distortion = {0.1, 0.2};
  EXPECT_TRUE(Json::parse(ros::to_json(info, 1)).contains("K"));
  EXPECT_TRUE(Json::parse(ros::to_json(info, 2)).contains("k"));
  for (const int generation : {1, 2}) {
    const auto read = ros::camera_info(ros::to_json(info, generation));
    EXPECT_EQ(read.K, info.K);
    EXPECT_EQ(read.width, 320);
    EXPECT_EQ(read.distortion, info.distortion);
  }
}

TEST(RosMessages, ReadsTheOdometryThatItWrites) {
  ros::Odometry odometry;
  odometry.header.stamp_ns = 1700000000123456789;
  odometry.position = {1, 2, 0};
  odometry.orientation = {0.6, 0, 0, 0.8};
  odometry.twist.linear.x() = 0.25;
  odometry.twist.angular.z() = -0.5;
  for (const int generation : {1, 2}) {
    const auto read = ros::odometry(ros::to_json(odometry, generation));
    EXPECT_EQ(read.header.stamp_ns, odometry.header.stamp_ns);
    EXPECT_EQ(read.position, odometry.position);
    EXPECT_EQ(read.orientation, odometry.orientation);
    EXPECT_EQ(read.twist.linear, odometry.twist.linear);
    EXPECT_EQ(read.twist.angular, odometry.twist.angular);
  }
}

TEST(RosMessages, ATwistMayBeStampedOrLackFields) {
  EXPECT_FALSE(ros::twist(R"({"linear": {"x": 0.1}})").stamp_ns);
  EXPECT_EQ(ros::twist(R"({"linear": {"x": 0.1}})").twist.linear.x(), 0.1);
  EXPECT_EQ(ros::twist("{}").twist.angular.z(), 0);
  const auto stamped =
      ros::twist(ros::to_json(ros::StampedTwist{5'000'000'001, {{0.1, 0, 0}, {0, 0, 0.2}}}, 1));
  EXPECT_EQ(stamped.stamp_ns, 5'000'000'001);
  EXPECT_EQ(stamped.twist.angular.z(), 0.2);
  EXPECT_FALSE(ros::twist(R"({"header": {"stamp": {"sec": 0, "nanosec": 0}}, "twist": {}})").stamp_ns)
      << "many publishers leave it 0";
}

TEST(RosMessages, NamesTheFieldThatIsWrong) {
  const auto why = [](const char* json) { return message_of([&] { ros::odometry(json); }); };
  EXPECT_HAS(why("{}"), "nav_msgs/Odometry: field \"header\" is missing");
  EXPECT_HAS(why(R"({"header": {"stamp": {"sec": 1}}})"),
             "header.stamp: field \"nanosec\" or \"nsecs\" is missing");
  EXPECT_HAS(why(R"({"header": {"stamp": {"sec": -1, "nanosec": 0}}})"), "\"sec\" = -1 must be 0");
  EXPECT_HAS(message_of([] { ros::twist(R"({"linear": {"x": null}})"); }),
             "linear: field \"x\" must be a finite number");
  EXPECT_HAS(message_of([] { ros::twist(R"({"linear": {"x": 1e999}})"); }), "Twist");
  EXPECT_HAS(message_of([] { ros::twist(R"({"linear": 3})"); }), "linear: must be an object");
  EXPECT_HAS(message_of([] { ros::twist("[]"); }), "must be an object");
  EXPECT_HAS(message_of([] { ros::boolean(R"({"data": 1})"); }), "true or false");
  EXPECT_HAS(
      message_of([] {
        ros::camera_info(R"({"header": {"stamp": {"sec": 1, "nanosec": 0}}, "width": 1e9, "height": 1})");
      }),
      "\"width\"");
}

TEST(RosMessages, SurviveATruncationAtEveryByte) {
  const std::string whole = ros::to_json(ros::Odometry{}, 2);
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_THROW(ros::odometry(whole.substr(0, n)), InputError) << n;
}

}  // namespace
}  // namespace incognita
