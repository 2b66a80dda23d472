#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/features/target_pose.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

const Camera wide(WideAngleCamera{.kd1 = 9e-6});
/// The corners of a sheet of paper on a wall.
const std::vector<Vector3d> sheet{{0, 0.14, 1.1}, {0, -0.14, 1.1}, {0, -0.14, 0.9}, {0, 0.14, 0.9}};

CameraState looking_at(const Vector3d& from, const Vector3d& at) {
  Eigen::Matrix3d axes;  // right, down, forward
  axes.col(2) = (at - from).normalized();
  axes.col(0) = axes.col(2).cross(Vector3d::UnitZ()).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  CameraState x = CameraState::Zero();
  x.head<3>() = from;
  x.segment<4>(3) = quaternion_from_matrix(axes);
  return x;
}

std::vector<Vector2d> pixels_from(const CameraState& x) {
  std::vector<Vector2d> pixels;
  for (const Vector3d& corner : sheet)
    pixels.push_back(PointLandmark::predict_measurement(wide, x, corner).value().pixel);
  return pixels;
}

/// Position and right rotation error of a solved pose.
Vector6 error(const TargetPose& pose, const CameraState& truth) {
  Vector6 e;
  e.head<3>() = pose.position - truth.head<3>();
  e.tail<3>() = quaternion_log<double>(
      quaternion_product<double>(quaternion_conjugate<double>(truth.segment<4>(3)), pose.world_from_camera));
  return e;
}

TEST(SolvePose, ExactPixelsGiveTheExactPose) {
  for (const CameraState& x :
       {looking_at({-0.5, 0.3, 1.2}, {0, 0, 1}), looking_at({-0.6, -0.4, 0.7}, {0, 0, 1}),
        looking_at({-0.4, 0.1, 1.05}, {0, 0.3, 1.1}),  // out in the lens' corner
        looking_at({-2, 0.9, 1.8}, {0, 0.2, 1})}) {
    const auto poses = solve_pose(sheet, pixels_from(x), wide, 1);
    ASSERT_FALSE(poses.empty());
    EXPECT_LE(poses.size(), 2u);
    EXPECT_LT(error(poses[0], x).norm(), 1e-7);
    EXPECT_LT(poses[0].rms_px, 1e-6);
    EXPECT_EQ(poses[0].second_rms_px, poses.back().rms_px);
    if (poses.size() == 2) {
      EXPECT_GT(poses[1].rms_px, poses[0].rms_px);
    }
  }
}

TEST(SolvePose, CovarianceIsThatOfRepeatedNoise) {
  const CameraState x = looking_at({-0.5, 0.35, 1.25}, {0, 0, 1});
  const std::vector<Vector2d> exact = pixels_from(x);
  constexpr double sigma_px = 0.1;
  const auto clean = solve_pose(sheet, exact, wide, sigma_px);
  ASSERT_FALSE(clean.empty());
  RandomStream random(1, "pixels");
  constexpr int runs = 2000;
  Matrix6 sum = Matrix6::Zero();
  for (int run = 0; run < runs; ++run) {
    std::vector<Vector2d> noisy = exact;
    for (Vector2d& pixel : noisy)
      for (int i = 0; i < 2; ++i) pixel[i] += sigma_px * random.normal();
    const auto poses = solve_pose(sheet, noisy, wide, sigma_px);
    ASSERT_FALSE(poses.empty());
    const Vector6 e = error(poses[0], x);
    sum += e * e.transpose();
  }
  // In units of the claimed covariance the found one must be the identity, in every direction
  const Eigen::LLT<Matrix6> llt(clean[0].covariance);
  ASSERT_EQ(llt.info(), Eigen::Success);
  const Matrix6 half = llt.matrixL().solve(sum / runs);
  const Matrix6 ratio = llt.matrixL().solve(half.transpose().eval());
  const Vector6 ratios = Eigen::SelfAdjointEigenSolver<Matrix6>(ratio).eigenvalues();
  EXPECT_GT(ratios.minCoeff(), 0.7);
  EXPECT_LT(ratios.maxCoeff(), 1.3);
}

TEST(SolvePose, CovarianceGrowsWithTheSquareOfTheNoise) {
  const std::vector<Vector2d> pixels = pixels_from(looking_at({-0.5, 0.35, 1.25}, {0, 0, 1}));
  const Matrix6 one = solve_pose(sheet, pixels, wide, 1).at(0).covariance;
  const Matrix6 three = solve_pose(sheet, pixels, wide, 3).at(0).covariance;
  EXPECT_LT((three - 9 * one).norm(), 1e-9 * three.norm());
}

TEST(SolvePose, NothingFromAPixelNoRayReaches) {
  std::vector<Vector2d> pixels = pixels_from(looking_at({-0.5, 0.35, 1.25}, {0, 0, 1}));
  pixels[2] = {500, 119.5};
  EXPECT_TRUE(solve_pose(sheet, pixels, wide, 1).empty());
}

}  // namespace
}  // namespace incognita
