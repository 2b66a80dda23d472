// Bearing-only measurement of a landmark by a planar vehicle, and landmark initialization from one bearing:
// thesis (3.19) without its first row; the bearing-only sensor of Section 4.2.
//
// Measurement (1): bearing (rad, from the body's heading, positive to the left, in (-pi, pi]).
// Two landmark parametrizations, as for the camera. A point (2) is its position. A planar inverse-distance
// landmark (4; Montiel, Civera, Davison, RSS 2006, reduced to the plane) is the position of the first
// observation, the direction from there and the inverse distance. Its measurement is nearly linear even when
// the distance is unknown, and it includes points at infinity.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

struct Bearing {
  static constexpr Chart chart{{Chart::Kind::angle, 1}};
  static constexpr Chart landmark_chart = Chart::line(2);
  static constexpr double least_range_m = 1e-6;  ///< below this distance a bearing is undefined
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

  /// Nothing for a point at the sensor's own position.
  static std::optional<Prediction> predict_measurement(const Pose& pose, const Eigen::Vector2d& point);
};

struct PlanarInverseDistance {
  static constexpr int size = 4;
  static constexpr Chart chart{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}, {Chart::Kind::line, 1}};
  template <class S>
  using State = Eigen::Matrix<S, size, 1>;  ///< x, y (m), direction (rad, from +x), inverse distance (1/m)
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

  /// Vector from the pose to the landmark, world axes, scaled by the inverse distance, so that it is finite
  /// at infinity.
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

  /// Nothing for a landmark at the sensor's own position.
  static std::optional<Prediction> predict_measurement(const Pose& pose, const State<double>& y);

  /// `inverse_distance` (1/m): prior mean; zero is allowed.
  static Initialization initialize(const Pose& pose, double bearing, double inverse_distance);

  /// Conversion to a point; requires a positive inverse distance.
  static Point point(const State<double>& y);

  /// Linearity index (Civera, Davison, Montiel, IEEE T-RO 2008, eq. 29): nonlinearity of the point's
  /// measurement over the spread of its distance; below about 0.1 the point parametrization is adequate. The
  /// paper derives it for a tangent in an image. It is the same for an angle: from distance d and at parallax
  /// a, a point d' further along its ray has direction atan2(d' sin a, d + d' cos a), whose second derivative
  /// by d' is -2 cos a / d times the first, as for the tangent.
  static double linearity_index(const State<double>& y, double inverse_distance_var,
                                const Eigen::Vector2d& sensor);
};

}  // namespace incognita
