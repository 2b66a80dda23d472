// The pinhole camera against OpenCV's, and where its distortion polynomial is not monotonic.
#include "incognita/models/sensors/pinhole_camera.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

namespace incognita {
namespace {

// barrel distortion as published for TUM's freiburg1, and strong tangential distortion
const PinholeCamera freiburg{640, 480, 517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
const PinholeCamera euroc{752,         480,        458.654,    457.296,        367.215, 248.375,
                          -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0};
const PinholeCamera plain{320, 240, 195, 190, 159.5, 119.5, 0, 0, 0, 0, 0};
const PinholeCamera tilted{320, 240, 195, 190, 150, 119.5, -0.1, 0.01, 0.01, -0.008, 0};
const std::vector<PinholeCamera> cameras = {freiburg, euroc, plain, tilted};

cv::Mat matrix(const PinholeCamera& c) {
  return (cv::Mat_<double>(3, 3) << c.fu, 0, c.u0, 0, c.fv, c.v0, 0, 0, 1);
}
cv::Mat distortion(const PinholeCamera& c) {
  return (cv::Mat_<double>(1, 5) << c.k1, c.k2, c.p1, c.p2, c.k3);
}

Eigen::Vector3d random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> side(-0.6, 0.6), depth(0.3, 8);
  const double z = depth(random);
  return {side(random) * z, side(random) * z, z};
}

TEST(PinholeCamera, ProjectsAsOpenCv) {
  std::mt19937 random(1);
  for (const PinholeCamera& camera : cameras) {
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d p = random_point(random);
      const std::vector<cv::Point3d> points = {{p.x(), p.y(), p.z()}};
      std::vector<cv::Point2d> pixels;
      cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), matrix(camera), distortion(camera),
                        pixels);
      EXPECT_NEAR(camera.h<double>(p).x(), pixels[0].x, 1e-9);
      EXPECT_NEAR(camera.h<double>(p).y(), pixels[0].y, 1e-9);
      EXPECT_NEAR((camera.project(p).pixel - camera.h<double>(p)).norm(), 0, 1e-12);
    }
  }
}

TEST(PinholeCamera, UnprojectsAsOpenCv) {
  for (const PinholeCamera& camera : {euroc, plain, tilted}) {
    for (double u = 20; u < camera.width; u += 37) {
      for (double v = 15; v < camera.height; v += 31) {
        std::vector<cv::Point2d> rays;
        cv::undistortPoints(std::vector<cv::Point2d>{{u, v}}, rays, matrix(camera), distortion(camera),
                            cv::noArray(), cv::noArray(),
                            cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12));
        const auto ray = camera.unproject({u, v});
        ASSERT_TRUE(ray) << u << " " << v;
        EXPECT_NEAR(ray->x(), rays[0].x, 1e-7);
        EXPECT_NEAR(ray->y(), rays[0].y, 1e-7);
      }
    }
  }
}

TEST(PinholeCamera, UnprojectIsTheInverseOfProjectAtEveryPixel) {
  for (const PinholeCamera& camera : cameras) {
    for (double u = 0; u <= camera.width - 1; u += 9.5) {
      for (double v = 0; v <= camera.height - 1; v += 9.5) {
        const auto ray = camera.unproject({u, v});
        ASSERT_TRUE(ray) << camera.fu << ": " << u << " " << v;
        EXPECT_TRUE(camera.defined(*ray));
        EXPECT_LT((camera.h<double>(*ray * 3.7) - Eigen::Vector2d(u, v)).norm(), 1e-6);
      }
    }
  }
}

TEST(PinholeCamera, JacobianEqualsDifferences) {
  std::mt19937 random(2);
  for (const PinholeCamera& camera : cameras) {
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p = random_point(random);
      const auto J = camera.project(p).J;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = 1e-6 * p.z() * Eigen::Vector3d::Unit(axis);
        const Eigen::Vector2d slope =
            (camera.h<double>(p + step) - camera.h<double>(p - step)) / (2e-6 * p.z());
        EXPECT_LT((J.col(axis) - slope).norm(), 1e-5 * (1 + slope.norm()));
      }
    }
  }
}

TEST(PinholeCamera, IsUndefinedBehind) {
  for (const PinholeCamera& camera : cameras) {
    EXPECT_FALSE(camera.defined({0.1, 0, -1}));
    EXPECT_FALSE(camera.defined({0.1, 0, 0}));
    EXPECT_FALSE(camera.defined({NAN, 0, 1}));
    EXPECT_TRUE(camera.defined({0, 0, 1}));
  }
}

// r (1 - 0.3 r^2) has its maximum at r = 1/sqrt(0.9), where its value is r (2/3)
TEST(PinholeCamera, IsUndefinedBeyondTheRadialMaximum) {
  PinholeCamera camera = plain;
  camera.k1 = -0.3;
  const double limit = 1 / std::sqrt(0.9);
  EXPECT_TRUE(camera.defined({0.999 * limit, 0, 1}));
  EXPECT_FALSE(camera.defined({1.001 * limit, 0, 1}));
  EXPECT_FALSE(camera.defined({0, 5 * limit, 1}));
  const double furthest = camera.fu * limit * 2 / 3;
  EXPECT_TRUE(camera.unproject({camera.u0 + 0.999 * furthest, camera.v0}));
  EXPECT_FALSE(camera.unproject({camera.u0 + 1.001 * furthest, camera.v0}));
  EXPECT_FALSE(camera.unproject({camera.u0 + 10 * furthest, camera.v0}));
}

// Beyond a minimum the polynomial increases again: points there are undefined too, whatever the local slope
TEST(PinholeCamera, StaysUndefinedBeyondAMinimum) {
  for (const bool with_k3 : {false, true}) {
    PinholeCamera camera = plain;
    camera.k1 = -1;
    camera.k2 = 0.3;
    camera.k3 = with_k3 ? 0.001 : 0;
    const auto slope = [&](double r) {
      const double s = r * r;
      return 1 + 3 * camera.k1 * s + 5 * camera.k2 * s * s + 7 * camera.k3 * s * s * s;
    };
    double first_turn = 0;
    while (slope(first_turn) > 0 && first_turn < 2) first_turn += 1e-4;
    ASSERT_GT(slope(2), 0);  // the polynomial does increase again
    for (double r = 0; r < 3; r += 0.01) EXPECT_EQ(camera.defined({r, 0, 1}), r < first_turn) << r;
  }
}

TEST(PinholeCamera, ResultsAreFiniteOrUndefined) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> k(-2, 2), tangential(-0.1, 0.1), pixel(-500, 900);
  for (int i = 0; i < 3000; ++i) {
    PinholeCamera camera = plain;
    camera.k1 = k(random), camera.k2 = k(random), camera.k3 = k(random);
    camera.p1 = tangential(random), camera.p2 = tangential(random);
    const Eigen::Vector2d at(pixel(random), pixel(random));
    if (const auto ray = camera.unproject(at)) {
      EXPECT_TRUE(camera.defined(*ray));
      EXPECT_LT((camera.h<double>(*ray) - at).norm(), 1e-5);
    }
  }
  EXPECT_FALSE(plain.unproject({NAN, 0}));
  EXPECT_FALSE(plain.unproject({INFINITY, 0}));
}

TEST(PinholeCamera, CheckNamesTheParameter) {
  const auto complaint = [](auto change) {
    PinholeCamera camera = plain;
    change(camera);
    try {
      Camera holder(camera);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto names = [](const std::string& text, const char* key) {
    return text.find(key) != std::string::npos;
  };
  EXPECT_EQ(complaint([](PinholeCamera&) {}), "none");
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.width = 3; }), "width_px"));
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.height = -3; }), "height_px"));
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.fu = 0; }), "fu_px"));
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.fv = -195; }), "fv_px"));
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.u0 = 320; }), "u0_px"));
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.v0 = NAN; }), "v0_px"));
  EXPECT_TRUE(names(complaint([](PinholeCamera& c) { c.k3 = INFINITY; }), "k3"));
}

}  // namespace
}  // namespace incognita
