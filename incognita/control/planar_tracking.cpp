#include "incognita/control/planar_tracking.hpp"

#include <cmath>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {

PlanarCommand track(const planar::Pose<double>& axle, const Reference& reference, const TrackingGains& gains,
                    const PlanarLimits& limits) {
  const Eigen::Vector2d error =
      planar::rotation(axle[2]).transpose() * (reference.position.head<2>() - axle.head<2>());
  const double turned = wrap_angle(reference.heading - axle[2]);
  const double speed = reference.velocity.head<2>().norm();
  const Eigen::Vector2d desired(speed * std::cos(turned) + gains.along_per_s * error.x(),
                                reference.heading_rate + speed * (gains.across_per_m2 * error.y() +
                                                                  gains.heading_per_m * std::sin(turned)));
  return limited(desired, limits);
}

}  // namespace incognita
