// Whether what is seen is the target's picture: on a camera's image that is drawn from the picture itself.
#include "incognita/slam/features/target_picture.hpp"

#include <gtest/gtest.h>

#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {
namespace {

const Camera wide_camera(WideAngleCamera{.kd1 = 9e-6});

/// 0.3 m wide, 0.2 m high, on the wall x = 0, facing -x; of three greys, so that it is like no mirror of
/// itself.
Target with_picture() {
  Target target;
  target.normal = {-1, 0, 0};
  Target::Picture picture{Image(60, 40, 230), {}};
  for (int v = 8; v < 32; ++v)
    for (int u = 10; u < 50; ++u) picture.image(u, v) = u < 25 && v < 18 ? 120 : 15;
  picture.world_from_px << 0, 0, 0, -0.005, 0, 0.15, 0, -0.005, 1.1;
  target.picture = picture;
  return target;
}

TargetPose pose_at(const Eigen::Vector3d& position) {
  const Eigen::Matrix3d along_x = (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
  TargetPose pose;
  pose.position = position;
  pose.world_from_camera = quaternion_from_matrix(along_x);
  return pose;
}

/// What a camera at the pose sees of the target on a wall of one grey.
Image seen_from(const TargetPose& pose, const Target& target) {
  const auto& [picture, world_from_px] = *target.picture;
  const Eigen::Matrix3d R = rotation_matrix(pose.world_from_camera);
  Image image(320, 240, 90);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const auto ray = wide_camera.unproject({u, v});
      if (!ray || (R * *ray).x() < 1e-3) continue;
      const Eigen::Vector3d d = R * *ray, at = pose.position - d * pose.position.x() / d.x();
      const double pu = (at.y() - world_from_px(1, 2)) / world_from_px(1, 0),
                   pv = (at.z() - world_from_px(2, 2)) / world_from_px(2, 1);
      if (pu < 0 || pv < 0 || pu > picture.width() - 1 || pv > picture.height() - 1) continue;
      image(u, v) = static_cast<std::uint8_t>(picture.sample(pu, pv));
    }
  return image;
}

double similarity(const Image& image, const TargetPose& pose) {
  return correlation_with_picture(with_picture(), wide_camera, image, pose);
}

TEST(TargetPicture, IsRecognizedFromItsPoseAndFromNoOther) {
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(-0.6, 0, 1), {-0.5, 0.4, 1.2}, {-1, -0.5, 0.8}, {-1.2, 0.2, 1}}) {
    const Image image = seen_from(pose_at(from), with_picture());
    EXPECT_GT(similarity(image, pose_at(from)), 0.95) << from.transpose();
    EXPECT_LT(similarity(image, pose_at(from + Eigen::Vector3d(0, 0.05, 0))), 0.85) << from.transpose();
    EXPECT_LT(similarity(image, pose_at(from * 0.6)), 0.85) << from.transpose();
  }
}

TEST(TargetPicture, IsNotWhatIsHardlyInView) {
  const Image image = seen_from(pose_at({-0.6, 0, 1}), with_picture());
  EXPECT_EQ(similarity(image, pose_at({-0.6, 2, 1})), -1) << "beside the image";
  EXPECT_EQ(similarity(image, pose_at({0.6, 0, 1})), -1) << "behind";
  EXPECT_EQ(similarity(Image(320, 240, 90), pose_at({-0.6, 0, 1})), -1) << "of one grey";
  EXPECT_THROW(correlation_with_picture(Target{}, wide_camera, image, pose_at({-0.6, 0, 1})),
               std::invalid_argument);
}

/// Light and contrast of the room are not those of the picture.
TEST(TargetPicture, IsRecognizedInOtherLight) {
  Image image = seen_from(pose_at({-0.6, 0.1, 1}), with_picture());
  const double before = similarity(image, pose_at({-0.6, 0.1, 1}));
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) image(u, v) = static_cast<std::uint8_t>(40 + image(u, v) / 2);
  EXPECT_NEAR(similarity(image, pose_at({-0.6, 0.1, 1})), before, 1e-3);
}

}  // namespace
}  // namespace incognita
