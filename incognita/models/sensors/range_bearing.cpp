#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita {

std::optional<RangeBearing::Prediction> RangeBearing::predict_measurement(const Pose& pose,
                                                                          const Eigen::Vector2d& point) {
  const double dx = point.x() - pose.x(), dy = point.y() - pose.y();
  const double d2 = dx * dx + dy * dy, d = std::sqrt(d2);
  if (!(d > least_range_m)) return std::nullopt;
  Prediction prediction{h<double>(pose, point), {}, {}};
  prediction.Hl << dx / d, dy / d, -dy / d2, dx / d2;
  prediction.Hv << -prediction.Hl, Eigen::Vector2d(0, -1);  // (3.20)
  return prediction;
}

RangeBearing::Initialization RangeBearing::initialize(const Pose& pose, const Eigen::Vector2d& z) {
  const double c = std::cos(pose[2] + z[1]), s = std::sin(pose[2] + z[1]);
  Initialization initialization{j<double>(pose, z), {}, {}};
  initialization.Jv << 1, 0, -z[0] * s, 0, 1, z[0] * c;
  initialization.Jz << c, -z[0] * s, s, z[0] * c;
  return initialization;
}

}  // namespace incognita
