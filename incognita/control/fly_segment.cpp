#include "incognita/control/fly_segment.hpp"

#include <cmath>

#include "incognita/control/paths/reference.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {

FreeCameraMotion::Input<double> fly_segment(const CameraState& state, const Segment& segment,
                                            const Heading& gaze, double t, const ControlSettings& settings) {
  const Reference r = minimum_jerk(segment.from, segment.to, segment.start_t, segment.end_t, t);
  // The world's z is -y of a level camera; raising the gaze turns about the camera's x
  const double c = std::cos(gaze.elevation_rad), s = std::sin(gaze.elevation_rad);
  const Eigen::Vector3d rate_in_camera(gaze.elevation_rate_rad_s, -gaze.rate_rad_s * c, gaze.rate_rad_s * s);
  return track_reference(state, r.position, r.velocity, r.acceleration, gaze_at(gaze.rad, gaze.elevation_rad),
                         rate_in_camera, settings);
}

}  // namespace incognita
