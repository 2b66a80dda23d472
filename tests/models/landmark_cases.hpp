// Cameras, points and errors shared by the tests of landmarks.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;
inline constexpr int camera_errors = FreeCameraMotion::error_size;

inline constexpr WideAngleCamera wide{.kd1 = 9e-6};  // field of view 100 degrees
inline constexpr PinholeCamera pinhole{.k1 = -0.28, .k2 = 0.07, .p1 = 2e-4, .p2 = 2e-5};

inline constexpr FisheyeCamera fisheye{
    .fu = 140, .fv = 140, .k1 = 0.0035, .k2 = 0.0007, .k3 = -0.0021, .k4 = 0.0002};

/// The camera displaced by its error, from the definition of the chart.
template <class S>
FreeCameraMotion::State<S> moved(const CameraState& x, const Eigen::Matrix<S, camera_errors, 1>& e) {
  FreeCameraMotion::State<S> y = x.cast<S>();
  y.template head<3>() += e.template head<3>();
  const Vector4<S> q = x.segment<4>(3).cast<S>();
  y.template segment<4>(3) =
      quaternion_product<S>(q, quaternion_exp<S>(Vector3<S>(e.template segment<3>(3))));
  y.template tail<6>() += e.template tail<6>();
  return y;
}

inline CameraState some_camera(RandomStream& random) {
  CameraState x;
  for (int i = 0; i < 13; ++i) x[i] = random.uniform(-2, 2);
  x.segment<4>(3).normalize();
  return x;
}

inline Vector3d to_world(const CameraState& x, const Vector3d& in_camera) {
  return x.head<3>() + rotation_matrix<double>(x.segment<4>(3)) * in_camera;
}

/// In camera axes: ordinary, far off the axis, a millimeter away, very far away.
inline std::vector<Vector3d> ordinary_and_nasty() {
  return {{0.2, -0.1, 1.5}, {0, 0, 2},       {3, 2, 1},           {-9, 0.1, 1},    {30, -40, 1},
          {0, 0, 1e-3},     {1e-3, 0, 1e-3}, {-4e-4, 3e-4, 1e-3}, {2e3, 1e3, 5e3}, {1e-9, -1e-9, 1}};
}

template <class A, class B>
void expect_near(const A& a, const B& b, double relative) {
  EXPECT_LE((a - b).norm(), relative * (1 + b.norm())) << "got\n" << a << "\nwanted\n" << b;
}

}  // namespace incognita
