#include "incognita/slam/features/follow_wheels.hpp"

namespace incognita {

UpdateReport follow_wheels(Belief& belief, BlockId camera, const WheelOdometry& odometry,
                           const Eigen::Vector2d& wheels) {
  const WheelOdometry::Look expected = odometry.look(FreeCameraMotion::State<double>(belief.mean(camera)));
  AffineLook affine;
  affine.add(camera, expected.H);
  affine.residual = WheelOdometry::measured(wheels) - expected.z;
  affine.R = expected.R;
  return belief.update({&affine, 1});
}

}  // namespace incognita
