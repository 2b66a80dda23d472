// What a sensor on a planar vehicle sees of a landmark when it sees directions only, and how a landmark is
// born from one direction. Thesis (3.19) without its first row; Section 4.2's bearing-only sensor.
//
// Measurement (1): bearing (rad, from the body's heading, positive to the left, in (-pi, pi]).
// Two landmark models, as for the camera. A point (2) is its position. A planar inverse-distance landmark (4;
// Montiel, Civera, Davison, RSS 2006, in the plane) is where it was first seen from, the direction it was
// seen in and one over its distance: its looks are nearly linear while the distance is not known, and
// infinity is a place.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "incognita/math/angles.hpp"
#include "incognita/models/planar_vehicle.hpp"

namespace incognita {

struct Bearing {
  static constexpr Chart chart{{Chart::Kind::angle, 1}};
  static constexpr Chart landmark_chart = Chart::line(2);
  static constexpr double least_range_m = 1e-6;  ///< nearer than this a bearing means nothing
  using Pose = planar::Pose<double>;
  using Scalar = Eigen::Matrix<double, 1, 1>;

  struct Prediction {
    Scalar z;                        ///< rad
    Eigen::Matrix<double, 1, 3> Hv;  ///< d(z) / d(pose error)
    Eigen::Matrix<double, 1, 2> Hl;  ///< d(z) / d(landmark)
  };

  template <class S>
  static Eigen::Matrix<S, 1, 1> h(const planar::Pose<S>& pose, const Eigen::Matrix<S, 2, 1>& point) {
    using std::atan2;
    return Eigen::Matrix<S, 1, 1>(wrap_angle<S>(atan2(point[1] - pose[1], point[0] - pose[0]) - pose[2]));
  }

  /// Nothing for a point where the sensor is.
  static std::optional<Prediction> predict_measurement(const Pose& pose, const Eigen::Vector2d& point) {
    const double dx = point.x() - pose.x(), dy = point.y() - pose.y();
    const double d2 = dx * dx + dy * dy;
    if (!(d2 > least_range_m * least_range_m)) return std::nullopt;
    Prediction prediction{h<double>(pose, point), {}, {}};
    prediction.Hl << -dy / d2, dx / d2;
    prediction.Hv << -prediction.Hl, -1;
    return prediction;
  }
};

struct PlanarInverseDistance {
  static constexpr int size = 4;
  static constexpr Chart chart{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}, {Chart::Kind::line, 1}};
  template <class S>
  using State = Eigen::Matrix<S, size, 1>;  ///< birth x, y (m), direction (rad, about z from +x), 1/m
  using Pose = planar::Pose<double>;

  struct Prediction {
    Bearing::Scalar z;               ///< rad
    Eigen::Matrix<double, 1, 3> Hv;  ///< d(z) / d(pose error)
    Eigen::Matrix<double, 1, 4> Hl;  ///< d(z) / d(landmark error)
  };
  struct Initialization {
    State<double> landmark;
    Eigen::Matrix<double, 4, 3> Jv;  ///< d(landmark error) / d(pose error)
    Eigen::Matrix<double, 4, 2> Jz;  ///< d(landmark error) / d(bearing, inverse distance)
  };
  struct Point {
    Eigen::Vector2d position;
    Eigen::Matrix<double, 2, 4> J;
  };

  /// From the pose to the landmark, world axes, as long as the distance at birth was times its inverse: its
  /// length means nothing, so infinity is as good as any place.
  template <class S>
  static Eigen::Matrix<S, 2, 1> along(const planar::Pose<S>& pose, const State<S>& y) {
    using std::cos, std::sin;
    return Eigen::Matrix<S, 2, 1>(y[3] * (y[0] - pose[0]) + cos(y[2]), y[3] * (y[1] - pose[1]) + sin(y[2]));
  }

  template <class S>
  static Eigen::Matrix<S, 1, 1> h(const planar::Pose<S>& pose, const State<S>& y) {
    using std::atan2;
    const Eigen::Matrix<S, 2, 1> a = along<S>(pose, y);
    return Eigen::Matrix<S, 1, 1>(wrap_angle<S>(atan2(a[1], a[0]) - pose[2]));
  }

  /// Nothing for a landmark where the sensor is.
  static std::optional<Prediction> predict_measurement(const Pose& pose, const State<double>& y) {
    const Eigen::Vector2d a = along<double>(pose, y);
    const double a2 = a.squaredNorm();
    if (!(a2 > std::pow(Bearing::least_range_m * y[3], 2))) return std::nullopt;
    const Eigen::RowVector2d turn(-a.y() / a2, a.x() / a2);  // d(direction) / d(along)
    Prediction prediction{h<double>(pose, y), {}, {}};
    prediction.Hv << -y[3] * turn, -1;
    prediction.Hl << y[3] * turn, turn * Eigen::Vector2d(-std::sin(y[2]), std::cos(y[2])),
        turn * (y.head<2>() - pose.head<2>());
    return prediction;
  }

  /// `inverse_distance` (1/m) is the mean before anything is known; zero is allowed.
  static Initialization initialize(const Pose& pose, double bearing, double inverse_distance) {
    Initialization initialization{
        {pose[0], pose[1], wrap_angle(pose[2] + bearing), inverse_distance}, {}, {}};
    initialization.Jv << Eigen::Matrix3d::Identity(), Eigen::RowVector3d::Zero();
    initialization.Jz << Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Identity();
    return initialization;
  }

  /// The same landmark as a point; needs a positive inverse distance.
  static Point point(const State<double>& y) {
    const double c = std::cos(y[2]), s = std::sin(y[2]), distance = 1 / y[3];
    Point point{{y[0] + distance * c, y[1] + distance * s}, {}};
    point.J << 1, 0, -distance * s, -distance * distance * c,  //
        0, 1, distance * c, -distance * distance * s;
    return point;
  }

  /// Civera's linearity index: how far from linear the look of the equivalent point would be over the
  /// distance's spread (Civera, Davison, Montiel, IEEE T-RO 2008, eq. 29); below about 0.1 a point is as
  /// good. There it is for a tangent in an image. For an angle it is the same: seen from d away under the
  /// parallax a, a point d' further along its ray has direction atan2(d' sin a, d + d' cos a), whose second
  /// derivative by d' is -2 cos a / d times the first, as that of the tangent is.
  static double linearity_index(const State<double>& y, double inverse_distance_var,
                                const Eigen::Vector2d& sensor) {
    if (!(y[3] > 0)) return 1e9;
    const Eigen::Vector2d at = point(y).position, from_sensor = at - sensor;
    const double d0 = 1 / y[3], d1 = from_sensor.norm();
    if (!(d1 > Bearing::least_range_m)) return 1e9;
    const double sigma_distance = std::sqrt(inverse_distance_var) * d0 * d0;
    const double cos_parallax = (at - y.head<2>()).dot(from_sensor) / (d0 * d1);
    return 4 * sigma_distance / d1 * std::abs(cos_parallax);
  }
};

}  // namespace incognita
