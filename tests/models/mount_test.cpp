// A camera mounted on a vehicle: its pose, and the exact Jacobian of this pose.
#include "incognita/models/motion/mount.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/grounds.hpp"
#include "tests/models/landmark_cases.hpp"

namespace incognita {
namespace {

using Eigen::Matrix3d;
using Dual3 = Dual<3>;

std::vector<Mount> mounts() {
  return {Mount{},
          {.forward_m = 0.3, .left_m = -0.1, .up_m = 0.6},
          {.forward_m = -2, .left_m = 1, .up_m = 1.5, .pitch_rad = -0.4, .yaw_rad = 2.5},
          {.up_m = 1, .pitch_rad = std::numbers::pi / 2, .yaw_rad = -std::numbers::pi}};
}

std::vector<Vector3d> poses() {
  return {
      {0, 0, 0}, {1, -2, std::numbers::pi}, {-3, 4, -3.1415}, {0.1, 0.2, std::numbers::pi / 2}, {7, 7, -2}};
}

/// The pose of the mounted camera of a displaced vehicle, by definition, as an error about `mean`.
Eigen::Matrix<double, 6, 3> exact(const Mount& mount, const Vector3<Dual3>& position,
                                  const Matrix3<Dual3>& axes, const CameraState& mean) {
  const Matrix3<Dual3> camera = axes * mount.body_from_camera().cast<Dual3>();
  const Vector3<Dual3> at = position + axes * mount.lever().cast<Dual3>();
  const Matrix3d R = rotation_matrix<double>(mean.segment<4>(3));
  Eigen::Matrix<double, 6, 3> J;
  J.topRows<3>() = derivatives<3, 3>(at);
  for (int i = 0; i < 3; ++i) {
    Matrix3d dR;
    for (int k = 0; k < 9; ++k) dR(k) = camera(k).derivatives()[i];
    const Matrix3d cross = R.transpose() * dR;
    J.bottomRows<3>().col(i) << cross(2, 1), cross(0, 2), cross(1, 0);
  }
  return J;
}

TEST(Mount, JacobianIsExactOnAPlanarVehicle) {
  for (const Mount& mount : mounts())
    for (const Vector3d& pose : poses()) {
      const auto mounted_pose = mount.on(on_floor(pose));
      const auto moved = variables<3>(pose);
      const Dual3 c = cos(moved[2]), s = sin(moved[2]), none(0), one(1);
      Matrix3<Dual3> axes;
      axes << c, -s, none, s, c, none, none, none, one;
      const auto J = exact(mount, {moved[0], moved[1], none}, axes, mounted_pose.camera);
      EXPECT_LE((mounted_pose.J - J).norm(), 1e-13 * J.norm());
    }
}

TEST(Mount, JacobianIsExactOnUnevenGround) {
  for (const Terrain& ground : {grounds::steep_waves(), grounds::small_height_map(), grounds::steep_slope()})
    for (const Mount& mount : mounts())
      for (const Vector3d& pose : poses()) {
        const TerrainVehicle vehicle{ground};
        const auto mounted_pose = mount.on(vehicle.pose(pose));
        const auto moved = variables<3>(pose);
        const auto J =
            exact(mount, vehicle.position<Dual3>(moved), vehicle.axes<Dual3>(moved), mounted_pose.camera);
        EXPECT_LE((mounted_pose.J - J).norm(), 1e-12 * J.norm());
      }
}

TEST(Mount, MeasurementThroughItHasTheVehiclesJacobian) {
  const TerrainVehicle vehicle{grounds::gentle_waves()};
  const Mount mount{.forward_m = 0.3, .left_m = 0.1, .up_m = 0.5, .pitch_rad = 0.2, .yaw_rad = -0.3};
  for (const Vector3d& pose : poses()) {
    const auto mounted_pose = mount.on(vehicle.pose(pose));
    const Vector3d point = to_world(mounted_pose.camera, {0.3, -0.2, 2});
    const auto prediction = PointLandmark::predict_measurement(Camera(wide), mounted_pose.camera, point);
    ASSERT_TRUE(prediction);
    const Eigen::Matrix<double, 2, 3> Hv = by_vehicle(prediction->Hv, mounted_pose.J);
    const auto moved = variables<3>(pose);
    const Matrix3<Dual3> axes = vehicle.axes<Dual3>(moved);
    const Vector3<Dual3> at = vehicle.position<Dual3>(moved) + axes * mount.lever().cast<Dual3>();
    const Matrix3<Dual3> camera = axes * mount.body_from_camera().cast<Dual3>();
    const Vector3<Dual3> in_camera = camera.transpose() * (point.cast<Dual3>() - at);
    expect_near(Hv, (derivatives<3, 2>(wide.h<Dual3>(in_camera))), 1e-11);
  }
}

TEST(Mount, HasTheStatedOrientation) {
  const auto level =
      Mount{.forward_m = 1, .left_m = 2, .up_m = 3}.on(on_floor({10, 20, std::numbers::pi / 2}));
  expect_near(Vector3d(level.camera.head<3>()), Vector3d(8, 21, 3), 1e-15);
  EXPECT_LE((rotation_matrix<double>(level.camera.segment<4>(3)) -
             rotation_matrix(level_gaze(std::numbers::pi / 2)))
                .norm(),
            1e-15);
  const auto ahead = [](const Mount& mount) -> Vector3d {
    const auto mounted_pose = mount.on(on_floor({0, 0, 0}));
    return rotation_matrix<double>(mounted_pose.camera.segment<4>(3)).col(2);
  };
  expect_near(ahead({.pitch_rad = 0.3}), Vector3d(std::cos(0.3), 0, std::sin(0.3)), 1e-15);
  expect_near(ahead({.yaw_rad = 0.3}), Vector3d(std::cos(0.3), std::sin(0.3), 0), 1e-15);
}

}  // namespace
}  // namespace incognita
