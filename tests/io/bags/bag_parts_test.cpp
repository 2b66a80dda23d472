// Pixels, calibrations and transforms of bags.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "incognita/io/recordings/bags/bag_camera.hpp"
#include "incognita/io/recordings/bags/bag_images.hpp"
#include "incognita/io/recordings/bags/bag_transforms.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using namespace std::string_literals;
using testing::message_of;

bags::ImageMessage image_of(const std::string& encoding, std::uint32_t width, std::uint32_t height,
                            std::uint32_t step, std::string_view data, bool is_big_endian = false) {
  return {{}, height, width, encoding, is_big_endian, step, data};
}

/// The gray value of one pixel.
int gray_of(const std::string& encoding, const std::string& pixel) {
  return gray_image(image_of(encoding, 1, 1, static_cast<std::uint32_t>(pixel.size()), pixel))(0, 0);
}

TEST(BagPixels, OfGrayImagesAreTakenRowByRow) {
  const std::string rows("\x0A\x14\x1E\x63\x28\x32\x3C\x63", 8);  // two rows of three, padded to 4
  for (const std::string encoding : {"mono8", "8UC1"}) {
    const Image image = gray_image(image_of(encoding, 3, 2, 4, rows));
    EXPECT_EQ(image.width(), 3);
    EXPECT_EQ(image(2, 0), 30);
    EXPECT_EQ(image(0, 1), 40);
    EXPECT_EQ(image(2, 1), 60);
  }
  const std::string deep("\x01\x80\xFF\x02", 4);  // 0x8001, 0x02FF
  EXPECT_EQ(gray_image(image_of("mono16", 2, 1, 4, deep))(0, 0), 0x80);
  EXPECT_EQ(gray_image(image_of("mono16", 2, 1, 4, deep))(1, 0), 0x02);
  EXPECT_EQ(gray_image(image_of("mono16", 2, 1, 4, deep, true))(1, 0), 0xFF);
}

TEST(BagPixels, OfColorImagesAreConvertedToGray) {
  EXPECT_EQ(gray_of("rgb8", "\xFF\0\0"s), 76);
  EXPECT_EQ(gray_of("bgr8", "\xFF\0\0"s), 29);
  EXPECT_EQ(gray_of("8UC3", "\0\0\xFF"s), 76);
  EXPECT_EQ(gray_of("rgba8", "\xFF\0\0\1"s), 76);
  EXPECT_EQ(gray_of("bgra8", "\xFF\0\0\1"s), 29);
  EXPECT_EQ(gray_of("8UC4", "\0\xFF\0\1"s), 150);
  const std::string pair("\x0A\x14\x1E\x28", 4);
  EXPECT_EQ(gray_image(image_of("yuv422", 2, 1, 4, pair))(1, 0), 0x28);
  EXPECT_EQ(gray_image(image_of("yuyv", 2, 1, 4, pair))(1, 0), 0x1E);
}

/// 8x8 px of a scene that is red: of the four Bayer patterns each has its red pixels at another place.
TEST(BagPixels, OfBayerPatternsFollowTheirName) {
  const std::pair<const char*, std::pair<int, int>> patterns[] = {
      {"bayer_rggb8", {0, 0}}, {"bayer_grbg8", {1, 0}}, {"bayer_gbrg8", {0, 1}}, {"bayer_bggr8", {1, 1}}};
  for (const auto& [encoding, red] : patterns) {
    std::string pixels(64, '\0');
    for (int v = red.second; v < 8; v += 2)
      for (int u = red.first; u < 8; u += 2) pixels[static_cast<std::size_t>(8 * v + u)] = '\xFF';
    const Image image = gray_image(image_of(encoding, 8, 8, 8, pixels));
    for (int v = 2; v < 6; ++v)
      for (int u = 2; u < 6; ++u) EXPECT_NEAR(image(u, v), 76, 1) << encoding;
  }
}

TEST(BagPixels, AreRefusedWhereTheSizesDoNotFit) {
  const std::string data(24, '\0');
  const auto refusal = [&](const bags::ImageMessage& m) {
    return message_of<std::runtime_error>([&] { gray_image(m); });
  };
  EXPECT_HAS(refusal(image_of("mono8", 5, 5, 5, data)),
             "5x5 px (mono8) has rows of 5 bytes and 24 bytes in all");
  EXPECT_EQ(refusal(image_of("mono8", 4, 5, 5, data)), "(none)") << "the last row needs no padding";
  EXPECT_HAS(refusal(image_of("rgb8", 4, 2, 11, data)), "rows of 11 bytes");
  EXPECT_HAS(refusal(image_of("mono8", 0, 5, 5, data)), "an image of 0x5 px");
  EXPECT_HAS(refusal(image_of("mono8", 4'000'000'000, 4'000'000'000, 4'000'000'000, data)),
             "4000000000x4000000000 px");
  EXPECT_HAS(refusal(image_of("32FC1", 1, 1, 4, data)),
             "encoding `32FC1` is not read; republish it as mono8");
  EXPECT_HAS(message_of<std::runtime_error>([&] {
               gray_image(bags::CompressedImageMessage{{}, "h264", data});
             }),
             "format `h264`: is not an image that can be decoded");
}

bags::CameraInfoMessage info_of(const std::string& model, const std::vector<double>& d) {
  bags::CameraInfoMessage info;
  info.width = 640, info.height = 480;
  info.distortion_model = model;
  info.d = d;
  info.k = {500, 0, 320, 0, 501, 240, 0, 0, 1};
  info.p = {490, 0, 321, 0, 0, 491, 241, 0, 0, 0, 1, 0};
  return info;
}

std::string unfit(const bags::CameraInfoMessage& info) { return calibrated_camera(info, false, "x")->unfit; }

TEST(BagCameraInfo, IsOneOfTheCameraModels) {
  const auto plumb_bob = calibrated_camera(info_of("plumb_bob", {1, 2, 3, 4, 5}), false, "bag: topic");
  EXPECT_EQ(plumb_bob->file, "bag: topic");
  EXPECT_EQ(plumb_bob->camera.fv_px, 501);
  EXPECT_EQ(std::get<PinholeLens>(plumb_bob->camera.model).k3, 5);
  const auto rational =
      calibrated_camera(info_of("rational_polynomial", {1, 2, 3, 4, 5, 0, 0, 0}), false, "x");
  EXPECT_EQ(std::get<PinholeLens>(rational->camera.model).p1, 3);
  const auto fisheye = calibrated_camera(info_of("equidistant", {1, 2, 3, 4}), false, "x");
  EXPECT_EQ(std::get<FisheyeLens>(fisheye->camera.model).k4, 4);
  const auto none = calibrated_camera(info_of("", {}), false, "x");
  EXPECT_EQ(std::get<PinholeLens>(none->camera.model).k1, 0);
  EXPECT_EQ(unfit(info_of("inverse_brown_conrady", {0, 0, 0, 0, 0})), "")
      << "as color cameras of RealSense state it";
}

TEST(BagCameraInfo, OfRectifiedImagesIsP) {
  const auto rectified = calibrated_camera(info_of("plumb_bob", {1, 2, 3, 4, 5}), true, "x");
  EXPECT_EQ(rectified->camera.fu_px, 490);
  EXPECT_EQ(rectified->camera.v0_px, 241);
  EXPECT_EQ(std::get<PinholeLens>(rectified->camera.model).k1, 0);
  EXPECT_TRUE(has_rectified_images("/cam/image_rect_color"));
  EXPECT_TRUE(has_rectified_images("/cam/image_rect/compressed"));
  for (const char* topic : {"/cam/image_raw", "/direct/image_raw", "/cam/image_unrectified", "/rect", ""})
    EXPECT_FALSE(has_rectified_images(topic)) << topic;
}

TEST(BagCameraInfo, SaysWhyNoCameraModelFits) {
  EXPECT_HAS(unfit(info_of("rational_polynomial", {1, 2, 3, 4, 5, 6, 7, 8})), "more than five coefficients");
  EXPECT_HAS(unfit(info_of("thin_prism", {1})), "distortion_model is `thin_prism`");
  auto binned = info_of("plumb_bob", {});
  binned.binning_x = 2;
  EXPECT_HAS(unfit(binned), "binned");
  auto part = info_of("plumb_bob", {});
  part.roi_width = 320, part.roi_height = 240;
  EXPECT_HAS(unfit(part), "region of interest");
  part.roi_width = 640, part.roi_height = 480;
  EXPECT_EQ(unfit(part), "");
}

TEST(BagCameraInfo, WithoutCalibrationIsNone) {
  auto info = info_of("plumb_bob", {});
  info.k = {};
  EXPECT_FALSE(calibrated_camera(info, false, "x"));
  EXPECT_FALSE(calibrated_camera(info_of("plumb_bob", {std::nan("")}), false, "x"));
  info = info_of("plumb_bob", {});
  info.width = 4'000'000'000;
  EXPECT_FALSE(calibrated_camera(info, false, "x"));
}

bags::PoseMessage transform(const std::string& parent, const std::string& child, double x, double turn = 0) {
  return {{0, parent}, child, {x, 0, 0}, {std::cos(turn / 2), 0, 0, std::sin(turn / 2)}};
}

constexpr std::int64_t ms = 1'000'000;

BagStamps at(std::int64_t time_ns) { return {time_ns, time_ns}; }

TEST(TransformTree, InterpolatesBetweenNeighborsThatAreNear) {
  TransformTree tree;
  tree.add(transform("world", "body", 1, 0), at(0), false);
  tree.add(transform("world", "body", 5, 1), at(200 * ms), false);
  tree.add(transform("world", "body", 3, 0.4), at(100 * ms), false);  // out of order
  tree.add(transform("world", "body", 9, 1), at(600 * ms), false);
  tree.sort(false);
  const auto chain = tree.to_root("body");
  EXPECT_EQ(chain, (std::vector<std::string>{"body", "world"}));
  const auto between = tree.pose(chain, 25 * ms);
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->position.x(), 1.5, 1e-12);
  EXPECT_NEAR(quaternion_log<double>(between->world_from_body).z(), 0.1, 1e-12);
  EXPECT_EQ(tree.pose(chain, 200 * ms)->position.x(), 5);
  EXPECT_FALSE(tree.pose(chain, 400 * ms)) << "a gap of 0.4 s";
  EXPECT_TRUE(tree.pose(chain, 600 * ms));
  EXPECT_FALSE(tree.pose(chain, -1));
  EXPECT_FALSE(tree.pose(chain, 601 * ms));
}

TEST(TransformTree, RelatesFramesThatDoNotMove) {
  TransformTree tree;
  for (int i = 0; i < 3; ++i) {
    tree.add(transform("world", "body", i, 0.5 * i), at(i * 100 * ms), false);
    tree.add(transform("body", "imu", 1), at(i * 100 * ms), false);  // sent again and again, as ROS 1 does
  }
  tree.add(transform("body", "mast", 2, 1), at(0), true);
  tree.add(transform("mast", "cam", 3), at(0), true);
  tree.sort(false);
  const auto imu_from_cam = tree.fixed_pose("imu", "cam");
  ASSERT_TRUE(imu_from_cam);
  EXPECT_NEAR((imu_from_cam->position - Eigen::Vector3d(1 + 3 * std::cos(1), 3 * std::sin(1), 0)).norm(), 0,
              1e-12);
  EXPECT_NEAR((tree.fixed_pose("cam", "imu")->position - inverse(*imu_from_cam).position).norm(), 0, 1e-12);
  EXPECT_FALSE(tree.fixed_pose("world", "cam"));
  EXPECT_FALSE(tree.fixed_pose("elsewhere", "cam"));
  EXPECT_TRUE(tree.fixed_pose("cam", "cam"));
}

TEST(TransformTree, SurvivesLoopsAndInvalidTransforms) {
  TransformTree tree;
  tree.add(transform("b", "a", 1), at(0), false);
  tree.add(transform("c", "b", 1), at(0), false);
  tree.add(transform("a", "c", 1), at(0), false);
  tree.add(transform("d", "d", 1), at(0), false);
  tree.add(transform("other", "a", 1), at(0), false);
  tree.add(transform("x", "y", std::numeric_limits<double>::quiet_NaN()), at(0), false);
  bags::PoseMessage scaled = transform("x", "z", 1);
  scaled.rotation *= 2;
  tree.add(scaled, at(0), false);
  tree.sort(false);
  EXPECT_EQ(tree.to_root("a"), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(tree.to_root("y"), (std::vector<std::string>{"y"}));
  EXPECT_EQ(tree.unused(), 4u);
}

}  // namespace
}  // namespace incognita
