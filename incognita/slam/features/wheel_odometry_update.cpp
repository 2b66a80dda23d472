#include "incognita/slam/features/wheel_odometry_update.hpp"

namespace incognita {

UpdateReport update_with_wheel_odometry(Belief& belief, BlockId camera, const WheelOdometry& odometry,
                                        const Eigen::Vector2d& wheels) {
  const WheelOdometry::Prediction expected =
      odometry.predict_measurement(FreeCameraMotion::State<double>(belief.mean(camera)));
  LinearizedMeasurement affine;
  affine.add(camera, expected.H);
  affine.residual = WheelOdometry::measured(wheels) - expected.z;
  affine.R = expected.R;
  return belief.update({&affine, 1});
}

}  // namespace incognita
