#include "incognita/models/sensors/bearing.hpp"

namespace incognita {

std::optional<Bearing::Prediction> Bearing::predict_measurement(const Pose& pose,
                                                                const Eigen::Vector2d& point) {
  const double dx = point.x() - pose.x(), dy = point.y() - pose.y();
  const double d2 = dx * dx + dy * dy;
  if (!(d2 > least_range_m * least_range_m)) return std::nullopt;
  Prediction prediction{h<double>(pose, point), {}, {}};
  prediction.Hl << -dy / d2, dx / d2;
  prediction.Hv << -prediction.Hl, -1;
  return prediction;
}

std::optional<PlanarInverseDistance::Prediction> PlanarInverseDistance::predict_measurement(
    const Pose& pose, const State<double>& y) {
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

PlanarInverseDistance::Initialization PlanarInverseDistance::initialize(const Pose& pose, double bearing,
                                                                        double inverse_distance) {
  Initialization initialization{{pose[0], pose[1], wrap_angle(pose[2] + bearing), inverse_distance}, {}, {}};
  initialization.Jv << Eigen::Matrix3d::Identity(), Eigen::RowVector3d::Zero();
  initialization.Jz << Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Identity();
  return initialization;
}

PlanarInverseDistance::Point PlanarInverseDistance::point(const State<double>& y) {
  const double c = std::cos(y[2]), s = std::sin(y[2]), distance = 1 / y[3];
  Point point{{y[0] + distance * c, y[1] + distance * s}, {}};
  point.J << 1, 0, -distance * s, -distance * distance * c,  //
      0, 1, distance * c, -distance * distance * s;
  return point;
}

double PlanarInverseDistance::linearity_index(const State<double>& y, double inverse_distance_var,
                                              const Eigen::Vector2d& sensor) {
  if (!(y[3] > 0)) return 1e9;
  const Eigen::Vector2d at = point(y).position, from_sensor = at - sensor;
  const double d0 = 1 / y[3], d1 = from_sensor.norm();
  if (!(d1 > Bearing::least_range_m)) return 1e9;
  const double sigma_distance = std::sqrt(inverse_distance_var) * d0 * d0;
  const double cos_parallax = (at - y.head<2>()).dot(from_sensor) / (d0 * d1);
  return 4 * sigma_distance / d1 * std::abs(cos_parallax);
}

}  // namespace incognita
