#include "incognita/control/fly_segment.hpp"

#include "incognita/control/paths/reference.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {

FreeCameraMotion::Input<double> fly_segment(const CameraState& state, const Segment& segment,
                                            const Heading& gaze, double t, const ControlSettings& settings) {
  const Reference r = minimum_jerk(segment.from, segment.to, segment.start_t, segment.end_t, t);
  const Eigen::Vector3d rate_in_camera(0, -gaze.rate_rad_s, 0);  // left about z is about -y of the camera
  return track_reference(state, r.position, r.velocity, r.acceleration, level_gaze(gaze.rad), rate_in_camera,
                         settings);
}

}  // namespace incognita
