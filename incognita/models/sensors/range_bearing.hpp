// Range and bearing of a point on the plane, and landmark initialization from them: thesis (3.19)-(3.22),
// (2.20)-(2.26).
//
// Measurement (2): range (m), bearing (rad, from the body's heading, positive to the left, in (-pi, pi]). The
// pi/2 in (3.19) is the beam convention of one laser and belongs to the reader of its data. For an anchor (a
// landmark at a known position) Hl is not used.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

struct RangeBearing {
  static constexpr Chart chart{{Chart::Kind::line, 1}, {Chart::Kind::angle, 1}};
  static constexpr Chart landmark_chart = Chart::line(2);
  static constexpr double least_range_m = 1e-6;  ///< below this distance a bearing is undefined
  using Pose = planar::Pose<double>;

  struct Prediction {
    Eigen::Vector2d z;               ///< m, rad
    Eigen::Matrix<double, 2, 3> Hv;  ///< d(z) / d(pose error)
    Eigen::Matrix2d Hl;              ///< d(z) / d(landmark)
  };
  struct Initialization {
    Eigen::Vector2d landmark;
    Eigen::Matrix<double, 2, 3> Jv;  ///< d(landmark) / d(pose error)
    Eigen::Matrix2d Jz;              ///< d(landmark) / d(z); (2.25) with the noise of z, not of the pose
  };

  template <class S>
  static Eigen::Matrix<S, 2, 1> h(const planar::Pose<S>& pose, const Eigen::Matrix<S, 2, 1>& point) {
    using std::atan2, std::sqrt;
    const S dx = point[0] - pose[0], dy = point[1] - pose[1];
    return Eigen::Matrix<S, 2, 1>(sqrt(dx * dx + dy * dy), wrap_angle<S>(atan2(dy, dx) - pose[2]));
  }

  /// Inverse of h: (2.22).
  template <class S>
  static Eigen::Matrix<S, 2, 1> j(const planar::Pose<S>& pose, const Eigen::Matrix<S, 2, 1>& z) {
    using std::cos, std::sin;
    const S direction = pose[2] + z[1];
    return Eigen::Matrix<S, 2, 1>(pose[0] + z[0] * cos(direction), pose[1] + z[0] * sin(direction));
  }

  /// Nothing for a point at the sensor's own position.
  static std::optional<Prediction> predict_measurement(const Pose& pose, const Eigen::Vector2d& point);

  static Initialization initialize(const Pose& pose, const Eigen::Vector2d& z);
};

}  // namespace incognita
