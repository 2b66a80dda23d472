// The pose of a camera on a vehicle, so that any vehicle can carry any camera.
//
//   const auto mounted = mount.on(on_floor(pose));          // or mount.on(terrain_vehicle.pose(x))
//   const auto prediction = PointLandmark::predict_measurement(camera, mounted.camera, point);
//   Hv = by_vehicle(prediction->Hv, mounted.J);            // d(z) / d(vehicle error)
//
// By default the camera looks along the body's forward axis with an upright image; it is then rotated to the left by
// `yaw_rad` and up by `pitch_rad`. Body axes: x forward, y left, z up. Camera axes: x right, y down, z forward.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/motion/quantity.hpp"
#include "incognita/models/motion/rigid_pose.hpp"

namespace incognita {

/// A camera mounted on a vehicle with `errors` errors.
template <int errors>
struct MountedCamera {
  FreeCameraMotion::State<double> camera;  ///< velocity and rate are zero: no measurement depends on them
  Eigen::Matrix<double, 6, errors> J;      ///< d(camera position and right rotation error) / d(vehicle error)
};

/// Pose of a planar vehicle on the floor z = 0.
PoseOf<3> on_floor(const planar::Pose<double>& pose);

struct Mount {
  double forward_m = 0;  ///< optical center relative to the vehicle's reference point, body axes
  double left_m = 0;
  double up_m = 0;
  double pitch_rad = 0;  ///< positive upwards
  double yaw_rad = 0;    ///< positive to the left

  static constexpr auto parameters() {
    using P = Parameter<Mount>;
    return std::array{
        P{{"forward", "m"},
          [](Mount& m) -> double& { return m.forward_m; },
          {-100, 100},
          "the optic center before the vehicle's point, in body axes"},
        P{{"left", "m"}, [](Mount& m) -> double& { return m.left_m; }, {-100, 100}, "left of it"},
        P{{"up", "m"}, [](Mount& m) -> double& { return m.up_m; }, {-100, 100}, "above it"},
        P{{"pitch", "rad"}, [](Mount& m) -> double& { return m.pitch_rad; }, {-1.6, 1.6}, "the view upward"},
        P{{"yaw", "rad"},
          [](Mount& m) -> double& { return m.yaw_rad; },
          {-3.2, 3.2},
          "the view to the left"}};
  }

  Vector3<double> lever() const { return {forward_m, left_m, up_m}; }

  /// Columns: the camera's right, down and forward axes in body axes.
  Matrix3<double> body_from_camera() const;

  /// Camera pose on the body. The camera moves by dp + R (e x lever) when the body moves by dp and rotates by
  /// e (body axes).
  template <int errors>
  MountedCamera<errors> on(const PoseOf<errors>& body) const {
    const Matrix3<double> world_from_body = rotation_matrix<double>(body.pose.world_from_body);
    const Matrix3<double> turned = body_from_camera();
    MountedCamera<errors> out;
    out.camera.setZero();
    out.camera.template head<3>() = body.pose.position + world_from_body * lever();
    out.camera.template segment<4>(3) =
        quaternion_product<double>(body.pose.world_from_body, quaternion_from_matrix(turned));
    const Eigen::Matrix<double, 3, errors> turn = body.J.template bottomRows<3>();
    out.J.template topRows<3>() =
        body.J.template topRows<3>() - world_from_body * skew<double>(lever()) * turn;
    out.J.template bottomRows<3>() = turned.transpose() * turn;
    return out;
  }
};

/// Jacobian of a measurement with respect to the vehicle error, from that with respect to the camera error.
template <int rows, int errors>
Eigen::Matrix<double, rows, errors> by_vehicle(
    const Eigen::Matrix<double, rows, FreeCameraMotion::error_size>& by_camera,
    const Eigen::Matrix<double, 6, errors>& mounted) {
  return by_camera.template leftCols<6>() * mounted;
}

}  // namespace incognita
