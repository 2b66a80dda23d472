// Every sensor on every vehicle that it fits, with measured points: ordinary and ill-conditioned. Shared by
// the tests of all sensors.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "incognita/math/angles.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/any_sensor.hpp"
#include "incognita/models/sensors/bearing.hpp"
#include "tests/models/landmark_cases.hpp"
#include "tests/models/registered.hpp"
#include "tests/small_vectors.hpp"

namespace incognita::sensor_cases {

using testing::minus;
using testing::plus;
using testing::vec;
inline constexpr double pi = std::numbers::pi;

/// dy/dx through the charts, from five points: the error is of fourth order in `step`.
inline SmallMatrix differences(const Chart& of, const SmallVector& x, const Chart& to,
                               const std::function<SmallVector(const SmallVector&)>& f, double step) {
  SmallMatrix J(to.tangent(), of.tangent());
  for (int k = 0; k < of.tangent(); ++k) {
    const auto at = [&](double by) { return f(plus(of, x, step * by * SmallVector::Unit(of.tangent(), k))); };
    J.col(k) = (8 * minus(to, at(1), at(-1)) - minus(to, at(2), at(-2))) / (12 * step);
  }
  return J;
}

inline void expect_jacobian(const SmallMatrix& J, const SmallMatrix& found, const std::string& of) {
  ASSERT_EQ(J.rows(), found.rows()) << of;
  ASSERT_EQ(J.cols(), found.cols()) << of;
  EXPECT_LE((J - found).norm(), 1e-7 * (1e-3 + found.norm())) << of << "\nanalytic\n"
                                                              << J << "\nfound\n"
                                                              << found;
}

// Every motion model with every sensor

using registered::motions;
using registered::sensors;
using registered::states;
inline const Mount mount = registered::some_mount;

/// Axes and position of the camera, from the vehicle's pose and the mount.
struct Lens {
  Eigen::Matrix3d axes;
  Eigen::Vector3d position;
  Eigen::Vector3d in_world(const Eigen::Vector3d& in_camera) const { return position + axes * in_camera; }
  Eigen::Vector3d in_camera(const Eigen::Vector3d& in_world) const {
    return axes.transpose() * (in_world - position);
  }
};

inline Lens lens_on(const AnyMotion& motion, const SmallVector& x) {
  const RigidPose pose = pose_of(motion, x);
  const Eigen::Matrix3d body = rotation_matrix<double>(pose.world_from_body);
  if (traits_of(motion).in_space()) return {body, pose.position};
  return {body * mount.body_from_camera(), pose.position + body * mount.lever()};
}

/// The camera model of a camera; empty for other sensors.
inline std::optional<Camera> lens_of(AnySensor sensor) {
  return std::visit(
      [](auto& s) -> std::optional<Camera> {
        if constexpr (requires { s.lens(); }) return s.lens();
        return std::nullopt;
      },
      sensor);
}

/// A vehicle and a landmark in its field of view.
struct Case {
  const AnyMotion& motion;
  const AnySensor& sensor;
  SmallVector vehicle;
  LandmarkParametrization form;
  SmallVector landmark;
  Chart chart;        ///< chart of the landmark
  SmallVector point;  ///< its position; empty at infinity and beyond
  double away_m;      ///< scale of the measurement's nonlinearity

  std::optional<AnyPrediction> predict() const {
    return predict_measurement(sensor, motion, vehicle, form, landmark);
  }
  std::string name() const {
    std::ostringstream text;
    text << traits_of(motion).name << ", " << traits_of(sensor).name << ", at " << vehicle.transpose()
         << ", sees " << landmark.transpose();
    return text.str();
  }
};

inline void add_on_line(std::vector<Case>& all, const AnyMotion& motion, const AnySensor& sensor,
                        const SmallVector& x) {
  for (const double away : {-20.0, -1e-6, 0.0, 3.0})
    all.push_back({motion, sensor, x, {}, vec({x[0] + away}), Chart::line(1), vec({x[0] + away}), 1});
}

/// Ahead, abeam, behind on both sides of the wrap; near and far; for bearings also as inverse distance, from
/// the vehicle's position and from another, up to infinity and past it.
inline void add_on_plane(std::vector<Case>& all, const AnyMotion& motion, const AnySensor& sensor,
                         const SmallVector& x) {
  for (const double bearing : {0.0, 1.2, pi / 2, -pi / 2, pi, pi - 1e-6, -pi + 1e-6, -2.5})
    for (const double range : {1e-3, 1.0, 40.0}) {
      const double way = x[2] + bearing;
      const SmallVector point = vec({x[0] + range * std::cos(way), x[1] + range * std::sin(way)});
      all.push_back({motion, sensor, x, {}, point, Chart::line(2), point, std::min(range, 1.0)});
      if (traits_of(sensor).initial_form == LandmarkParametrization::Kind::point) continue;
      const LandmarkParametrization form{LandmarkParametrization::Kind::inverse_depth, {1, 0, 0, 0}};
      for (const Eigen::Vector2d& from : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.4, -2)}) {
        const Eigen::Vector2d seen = point - (x.head<2>() + from);
        const SmallVector y =
            vec({x[0] + from.x(), x[1] + from.y(), std::atan2(seen.y(), seen.x()), 1 / seen.norm()});
        all.push_back(
            {motion, sensor, x, form, y, PlanarInverseDistance::chart, point, std::min(range, 1.0)});
      }
      for (const double inverse : {0.0, 1e-9, -1e-3})
        all.push_back({motion,
                       sensor,
                       x,
                       form,
                       vec({x[0] + 0.2, x[1] - 0.1, wrap_angle(way), inverse}),
                       PlanarInverseDistance::chart,
                       {},
                       1});
    }
}

/// Pixels in the middle, anywhere, and at the edges of the image; near and far; as points and as inverse
/// depth from another view, up to infinity and past it.
inline void add_in_space(std::vector<Case>& all, const AnyMotion& motion, const AnySensor& sensor,
                         const SmallVector& x) {
  const Camera camera = *lens_of(sensor);
  const Lens lens = lens_on(motion, x);
  const double right = camera.width() - 1, low = camera.height() - 1;
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(160, 120), Eigen::Vector2d(37, 201), Eigen::Vector2d(1e-6, 1e-6),
        Eigen::Vector2d(right - 1e-6, 60), Eigen::Vector2d(right + 1e-6, 70), Eigen::Vector2d(100, low + 3)})
    for (const double depth : {0.05, 2.0, 60.0}) {
      const Eigen::Vector3d ray = *camera.unproject(pixel);
      const SmallVector point = lens.in_world(depth * ray);
      all.push_back({motion, sensor, x, {}, point, Chart::line(3), point, std::min(depth, 1.0)});
      const Eigen::Vector4d initial_axes = quaternion_product<double>(
          quaternion_from_matrix(lens.axes), quaternion_exp<double>(Eigen::Vector3d(0.1, -0.2, 0.3)));
      const LandmarkParametrization form{LandmarkParametrization::Kind::inverse_depth, initial_axes};
      const Eigen::Vector3d from = lens.in_world({-0.02, 0.01, -0.03});
      const Eigen::Matrix3d to_initial_camera = rotation_matrix<double>(initial_axes).transpose();
      const auto moved = [&](const Eigen::Vector3d& in_initial_camera, double inverse) -> SmallVector {
        return vec({from.x(), from.y(), from.z(), in_initial_camera.x() / in_initial_camera.z(),
                    in_initial_camera.y() / in_initial_camera.z(), inverse});
      };
      const Eigen::Vector3d seen = to_initial_camera * (Eigen::Vector3d(point) - from),
                            far = to_initial_camera * lens.axes * ray;
      all.push_back({motion, sensor, x, form, moved(seen, 1 / seen.z()), InverseDepthLandmark::chart, point,
                     std::min(depth, 1.0)});
      for (const double inverse : {0.0, 1e-9, -1e-3})
        all.push_back({motion, sensor, x, form, moved(far, inverse), InverseDepthLandmark::chart, {}, 1});
    }
}

inline void for_every_case(const std::function<void(const Case&)>& with) {
  int tried = 0;
  const std::vector<AnySensor> all_sensors = sensors();
  for (const AnyMotion& motion : motions())
    for (const AnySensor& sensor : all_sensors) {
      if (!incompatibility(motion, sensor).empty()) continue;
      std::vector<Case> all;
      for (const SmallVector& x : states(motion))
        dimensions_of(sensor) == 1   ? add_on_line(all, motion, sensor, x)
        : dimensions_of(sensor) == 2 ? add_on_plane(all, motion, sensor, x)
                                     : add_in_space(all, motion, sensor, x);
      for (const Case& one : all) with(one), ++tried;
    }
  EXPECT_GT(tried, 1000);
}

}  // namespace incognita::sensor_cases
