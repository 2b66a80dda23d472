#include "incognita/world/rendered/render.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgproc.hpp>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/rendered/room_bodies.hpp"

using namespace incognita;

namespace {

const Room& room() {
  static const Room shared(RoomSettings{}, 1);
  return shared;
}

struct Pose {
  Eigen::Vector3d position;
  Eigen::Vector4d world_from_camera;
};

Pose pose(double x, double y, double z, double heading, const Eigen::Vector3d& turn = {0, 0, 0}) {
  return {{x, y, z}, quaternion_product<double>(level_gaze(heading), quaternion_exp<double>(turn))};
}

Image picture(const Camera& camera, const Pose& at) {
  Image out;
  render(room(), RayTable(camera), at.position, at.world_from_camera, out);
  return out;
}

double standard_deviation(const Image& image) {
  double sum = 0, squares = 0;
  const int count = image.width() * image.height();
  for (int i = 0; i < count; ++i) {
    const double g = image.row(0)[i];
    sum += g;
    squares += g * g;
  }
  return std::sqrt(squares / count - sum / count * sum / count);
}

/// The corner near a pixel by OpenCV: the point orthogonal to all gradients around it.
Eigen::Vector2d refined(const Image& image, const Eigen::Vector2d& near) {
  const cv::Mat gray(image.height(), image.width(), CV_8U, const_cast<std::uint8_t*>(image.row(0)));
  std::vector<cv::Point2f> corner{{static_cast<float>(near.x()), static_cast<float>(near.y())}};
  cv::cornerSubPix(gray, corner, {5, 5}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-3});
  return {corner[0].x, corner[0].y};
}

Eigen::Vector2d projected(const Camera& camera, const Pose& at, const Eigen::Vector3d& point) {
  const Eigen::Matrix3d camera_from_world = rotation_matrix<double>(at.world_from_camera).transpose();
  const auto projection = camera.project(camera_from_world * (point - at.position));
  EXPECT_TRUE(projection && camera.contains(projection->pixel, 10)) << "the sheet is out of view";
  return projection->pixel;
}

/// Distance of the black-white edge from `on_edge` along `out`, a unit vector to the white side. The integral
/// over the profile across an edge, whatever its blur, is its position.
double edge_offset(const Image& image, const Eigen::Vector2d& on_edge, const Eigen::Vector2d& out) {
  constexpr double reach = 4, step = 0.05;
  const auto gray = [&](double s) {
    return image.sample(on_edge.x() + s * out.x(), on_edge.y() + s * out.y());
  };
  const double black = gray(-reach), white = gray(reach);
  double dark = 0;
  for (double s = -reach + step / 2; s < reach; s += step) dark += step * (white - gray(s)) / (white - black);
  return dark - reach;
}

class Corners : public testing::TestWithParam<Camera> {
 protected:
  const Camera camera = GetParam();
  const Pose poses[5] = {pose(1.6, 0, 1.3, 0), pose(1.8, 0.3, 1.2, -0.2),
                         pose(1.5, -0.4, 1.5, 0.15, {0.1, 0, 0.3}), pose(0.8, 0.2, 1.4, 0.1, {0, 0, -0.5}),
                         pose(1.9, -0.7, 1.0, 0.5, {0.15, 0.1, 0})};
};

/// Camera model, axes, room and renderer agree: the edges of the black rectangle, and so its corners, are
/// where the model projects them, from many poses.
TEST_P(Corners, OfTheSheetAreJoinedByEdgesWhereTheCameraModelProjectsThem) {
  const auto corners = room().layout().sheet.corners();
  const Eigen::Vector3d middle = 0.5 * (corners[0] + corners[2]);
  for (const Pose& at : poses) {
    const Image image = picture(camera, at);
    for (int side = 0; side < 4; ++side) {
      const Eigen::Vector3d from = corners[side], way = corners[(side + 1) % 4] - from;
      for (const double along : {0.2, 0.35, 0.5, 0.65, 0.8}) {
        const Eigen::Vector3d edge = from + along * way;
        const Eigen::Vector2d pixel = projected(camera, at, edge);
        const Eigen::Vector2d tangent = projected(camera, at, edge + 0.01 * way) - pixel;
        Eigen::Vector2d out(tangent.y(), -tangent.x());
        if (out.dot(projected(camera, at, middle) - pixel) > 0) out = -out;
        EXPECT_NEAR(edge_offset(image, pixel, out.normalized()), 0, 0.1) << "at " << pixel.transpose();
      }
    }
  }
}

/// The same with a corner detector. It displaces every corner with one black quadrant inwards, here by up to
/// 0.3 px; over the four corners of a rectangle this cancels.
TEST_P(Corners, OfTheSheetAreDetectedWhereTheCameraModelProjectsThem) {
  for (const Pose& at : poses) {
    const Image image = picture(camera, at);
    Eigen::Vector2d mean(0, 0);
    for (const Eigen::Vector3d& corner : room().layout().sheet.corners()) {
      const Eigen::Vector2d pixel = projected(camera, at, corner);
      const Eigen::Vector2d apart = refined(image, pixel + Eigen::Vector2d(1.2, -0.8)) - pixel;
      EXPECT_LT(apart.norm(), 0.35) << "at " << pixel.transpose() << " apart " << apart.transpose();
      mean += apart / 4;
    }
    EXPECT_LT(mean.norm(), 0.1) << mean.transpose();
  }
}
INSTANTIATE_TEST_SUITE_P(distortion, Corners,
                         testing::Values(Camera(WideAngleCamera{}), Camera(WideAngleCamera{.kd1 = 9e-6}),
                                         Camera(FisheyeCamera{.k1 = -0.03, .k2 = 0.01})));

TEST(Render, LeftInTheWorldIsLeftInTheImage) {
  const Image image = picture(WideAngleCamera{}, pose(1.6, 0, 1.3, 0));
  EXPECT_LT(image(159, 119), 30) << "the black rectangle in the middle";
  EXPECT_GT(image(159 - 40, 119), 220) << "white paper left of it";
  EXPECT_GT(image(159, 119 + 28), 220) << "and below it";
  // a turn to the right moves the sheet to the left
  const Image right = picture(WideAngleCamera{}, pose(1.6, 0, 1.3, -0.4));
  EXPECT_LT(right(159 - 82, 119), 30);
}

TEST(Render, EveryViewIsTextured) {
  for (double x : {-1.5, 0.0, 1.5})
    for (double heading = 0; heading < 2 * std::numbers::pi; heading += 0.5)
      EXPECT_GT(standard_deviation(picture(WideAngleCamera{.kd1 = 9e-6}, pose(x, 0.2, 1.3, heading))), 25)
          << x << " " << heading;
  for (const double pitch : {-1.5, 1.5})
    EXPECT_GT(standard_deviation(picture(WideAngleCamera{}, pose(0, 0, 1.3, 0.3, {pitch, 0, 0}))), 15)
        << pitch;
}

/// Patches for the search need texture: corners are detected all over each wall.
TEST(Render, CornersAreEverywhere) {
  for (double heading = 0; heading < 2 * std::numbers::pi; heading += 0.5) {
    const Image image = picture(WideAngleCamera{.kd1 = 9e-6}, pose(0, 0, 1.3, heading));
    const cv::Mat gray(image.height(), image.width(), CV_8U, const_cast<std::uint8_t*>(image.row(0)));
    cv::Mat strength;
    cv::cornerMinEigenVal(gray, strength, 9, 3);
    for (int v = 0; v < 4; ++v)
      for (int u = 0; u < 4; ++u) {
        double best = 0;
        cv::minMaxLoc(strength(cv::Rect(80 * u, 60 * v, 80, 60)), nullptr, &best);
        EXPECT_GT(best, 2e-4) << heading << " " << u << " " << v;  // noise of 2 gray levels alone gives 2e-5
      }
  }
}

TEST(Render, DependsOnThePoseAlone) {
  const RayTable rays{Camera(WideAngleCamera{.kd1 = 9e-6})};
  const Pose here = pose(0.5, 0.5, 1.3, 1.0), there = pose(-1, 0.2, 0.8, 3.0);
  Image first, again;
  render(room(), rays, here.position, here.world_from_camera, first);
  render(room(), rays, there.position, there.world_from_camera, again);
  EXPECT_NE(first, again);
  render(room(), rays, here.position, here.world_from_camera, again);
  EXPECT_EQ(first, again);
  render(room(), rays, here.position, -here.world_from_camera, again);
  EXPECT_EQ(first, again) << "q and -q are the same orientation";
}

TEST(Render, ARoomIsDeterminedByItsSeed) {
  const RayTable rays{Camera(WideAngleCamera{})};
  const Pose here = pose(0, 0, 1.3, 2.0);
  Image same, other, reference = picture(WideAngleCamera{}, here);
  render(Room(RoomSettings{}, 1), rays, here.position, here.world_from_camera, same);
  render(Room(RoomSettings{}, 2), rays, here.position, here.world_from_camera, other);
  EXPECT_EQ(same, reference);
  EXPECT_NE(other, reference);
}

/// Tiles that contain a single wall are rendered by a shortcut: it must not change the image.
TEST(Render, ACameraWithShiftedTilesHasTheSameImage) {
  const WideAngleCamera whole{.width = 320, .height = 240};
  WideAngleCamera shifted = whole;  // without five columns and three rows: tiles begin elsewhere
  shifted.width -= 5, shifted.height -= 3, shifted.u0 -= 5, shifted.v0 -= 3;
  for (double heading = 0; heading < 6; heading += 0.37) {
    const Pose at = pose(0.4, -0.3, 1.2, heading, {0.2, 0, 0.1});
    const Image a = picture(whole, at), b = picture(shifted, at);
    int differ = 0;
    for (int v = 1; v < b.height() - 1; ++v)
      for (int u = 1; u < b.width() - 1; ++u) differ += std::abs(a(u + 5, v + 3) - b(u, v)) > 1;
    EXPECT_LE(differ, 2) << heading;  // a ray on an edge between two surfaces may be rounded to either
  }
}

/// A pixel is the average over its area: without aliasing small motions make small changes.
TEST(Render, AnImageIsTheAverageOfAFinerOne) {
  const WideAngleCamera coarse;
  const WideAngleCamera fine{.width = 1280, .height = 960, .fu = 780, .fv = 780, .u0 = 639.5, .v0 = 479.5};
  double squares = 0;
  int count = 0;
  for (const double heading : {0.3, 1.9, 3.5, 5.1}) {
    const Pose at = pose(0.2, 0.1, 1.3, heading);
    const Image a = picture(coarse, at), b = picture(fine, at);
    for (int v = 2; v < 238; ++v)
      for (int u = 2; u < 318; ++u, ++count) {
        double mean = 0;
        for (int i = 0; i < 16; ++i) mean += b(4 * u + i % 4, 4 * v + i / 4) / 16.0;
        squares += (a(u, v) - mean) * (a(u, v) - mean);
      }
  }
  EXPECT_LT(std::sqrt(squares / count), 12);
}

TEST(Render, PixelsWithoutARayAreBlack) {
  const WideAngleCamera fisheye{.kd1 = 3e-5};  // the image of infinity is a circle of 129 px
  const Image image = picture(fisheye, pose(0, 0, 1.3, 0));
  EXPECT_EQ(image(0, 0), 0);
  EXPECT_EQ(image(319, 239), 0);
  EXPECT_GT(image(159, 119), 0);
}

TEST(Render, OutsideTheRoomTheImageIsBlack) {
  const Image image = picture(WideAngleCamera{}, pose(3.5, 0, 1.3, 0));
  EXPECT_EQ(image, Image(320, 240));
}

}  // namespace
