// The fisheye camera against OpenCV's, close to 90 degrees and beyond, and where its polynomial is not monotonic.
#include "incognita/models/sensors/fisheye_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// as published for TUM VI, and a lens with strong distortion
const FisheyeCamera tum_vi{512,     512,     190.978,  190.973,  254.932,
                           256.897, 0.00348, 0.000715, -0.00205, 0.000202};
const FisheyeCamera strong{640, 480, 300, 310, 320, 245, -0.05, 0.03, -0.02, 0.004};
const FisheyeCamera equidistant{};

cv::Mat matrix(const FisheyeCamera& c) {
  return (cv::Mat_<double>(3, 3) << c.fu, 0, c.u0, 0, c.fv, c.v0, 0, 0, 1);
}
cv::Vec4d distortion(const FisheyeCamera& c) { return {c.k1, c.k2, c.k3, c.k4}; }

/// The point at an angle from the optical axis, in a direction of the image.
Vector3d at(double theta, double direction, double distance = 1) {
  return distance * Vector3d(std::sin(theta) * std::cos(direction), std::sin(theta) * std::sin(direction),
                             std::cos(theta));
}

TEST(FisheyeCamera, ProjectsAsOpenCv) {
  for (const FisheyeCamera& camera : {tum_vi, strong, equidistant})
    for (double theta = 0.01; theta < 1.56; theta += 0.03)
      for (double direction = 0; direction < 6; direction += 0.5) {
        const Vector3d p = at(theta, direction, 3);
        std::vector<cv::Point2d> pixels;
        cv::fisheye::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, pixels,
                                   cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), matrix(camera),
                                   distortion(camera));
        EXPECT_NEAR(camera.h<double>(p).x(), pixels[0].x, 1e-9) << theta;
        EXPECT_NEAR(camera.h<double>(p).y(), pixels[0].y, 1e-9) << theta;
        EXPECT_LT((camera.project(p).pixel - camera.h<double>(p)).norm(), 1e-11) << theta;
      }
}

TEST(FisheyeCamera, UnprojectsAsOpenCv) {
  for (double u = 70; u < 440; u += 23)
    for (double v = 70; v < 440; v += 29) {
      std::vector<cv::Point2d> rays;
      cv::fisheye::undistortPoints(std::vector<cv::Point2d>{{u, v}}, rays, matrix(tum_vi),
                                   distortion(tum_vi));
      const auto ray = tum_vi.unproject({u, v});
      ASSERT_TRUE(ray) << u << " " << v;
      EXPECT_NEAR(ray->x(), rays[0].x, 1e-6 * (1 + ray->norm()));
      EXPECT_NEAR(ray->y(), rays[0].y, 1e-6 * (1 + ray->norm()));
    }
}

/// The series near the axis and the quotients beyond have the same value and derivative.
TEST(FisheyeCamera, IsSmoothNearTheAxis) {
  for (const FisheyeCamera& camera : {tum_vi, strong, equidistant}) {
    const Projection below = camera.project({0.999999e-3, 0, 1}), above = camera.project({1.000001e-3, 0, 1});
    EXPECT_LT((below.J - above.J).norm(), 1e-5);
    EXPECT_NEAR(above.pixel.x() - below.pixel.x(), 2e-9 * camera.fu, 1e-10);
    EXPECT_NEAR(camera.project({0, 0, 2}).J(0, 0), camera.fu / 2, 1e-9);
  }
}

/// Pixels are defined up to 1 mrad before 90 degrees, where a pixel still has a finite ray.
TEST(FisheyeCamera, EndsShortlyBeforeNinetyDegrees) {
  const double quarter = std::acos(0.0);
  EXPECT_TRUE(equidistant.defined(at(quarter - 1.1e-3, 0.3)));
  EXPECT_FALSE(equidistant.defined(at(quarter - 0.9e-3, 0.3)));
  EXPECT_FALSE(equidistant.defined(at(quarter + 0.1, 0.3)));
  const Vector2d last = equidistant.h<double>(at(quarter - 1.1e-3, 0.3));
  const auto ray = equidistant.unproject(last);
  ASSERT_TRUE(ray);
  EXPECT_LT((ray->normalized() - at(quarter - 1.1e-3, 0.3)).norm(), 1e-9);
  EXPECT_FALSE(equidistant.unproject({equidistant.u0 + equidistant.fu * (quarter - 0.9e-3), equidistant.v0}));
  EXPECT_FALSE(equidistant.unproject({equidistant.u0 + 10 * equidistant.fu, equidistant.v0}));
}

/// Beyond the first maximum of theta_d no point is defined, even where the polynomial rises again.
TEST(FisheyeCamera, EndsWhereThePolynomialTurnsBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> k(-0.6, 0.6);
  int turned = 0;
  for (int i = 0; i < 300; ++i) {
    FisheyeCamera camera = equidistant;
    camera.k1 = k(random), camera.k2 = k(random), camera.k3 = k(random), camera.k4 = k(random);
    const auto slope = [&](double theta) {
      const double t = theta * theta;
      return 1 + t * (3 * camera.k1 + t * (5 * camera.k2 + t * (7 * camera.k3 + t * 9 * camera.k4)));
    };
    double turn = 0;
    while (turn < 1.5698 && slope(turn) > 0) turn += 1e-4;
    turned += turn < 1.569;
    for (double theta = 0.005; theta < 1.565; theta += 0.01) {
      if (std::abs(theta - turn) < 2e-3) continue;
      EXPECT_EQ(camera.defined(at(theta, 1)), theta < turn) << theta << " " << turn;
    }
    const double edge_px =
        camera.fu * turn *
        (1 +
         turn * turn *
             (camera.k1 + turn * turn * (camera.k2 + turn * turn * (camera.k3 + turn * turn * camera.k4))));
    EXPECT_FALSE(camera.unproject({camera.u0 + edge_px + 0.5, camera.v0}));
    const auto ray = camera.unproject({camera.u0 + 0.95 * edge_px, camera.v0});
    ASSERT_TRUE(ray);
    EXPECT_TRUE(camera.defined(*ray));
    EXPECT_NEAR(camera.h<double>(*ray).x(), camera.u0 + 0.95 * edge_px, 1e-9);
  }
  EXPECT_GT(turned, 50);
}

TEST(FisheyeCamera, ResultsAreFiniteOrUndefined) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_FALSE(equidistant.unproject({bad, 3}));
    EXPECT_FALSE(equidistant.defined({bad, 0, 1}));
  }
  EXPECT_FALSE(equidistant.defined({0, 0, -1}));
  const auto center = equidistant.unproject({equidistant.u0, equidistant.v0});
  ASSERT_TRUE(center);
  EXPECT_EQ(*center, Vector3d(0, 0, 1));
}

}  // namespace
}  // namespace incognita
