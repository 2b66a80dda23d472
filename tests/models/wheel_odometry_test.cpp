// Wheel odometry as a measurement of the camera on the vehicle: its Jacobian, and a vehicle on uneven ground
// satisfies it.
#include "incognita/models/sensors/wheel_odometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/grounds.hpp"

namespace incognita {
namespace {

using State = FreeCameraMotion::State<double>;
using Error = Eigen::Matrix<double, FreeCameraMotion::error_size, 1>;

const WheelOdometry odometry{{0.2, -0.1, 0.7, -0.2, 0.3}, 0.05, 0.02, 0.01};

State drawn(RandomStream& random, double scale) {
  State x;
  for (double& number : x) number = scale * random.normal();
  x.segment<4>(3).normalize();
  return x;
}

/// h of the state plus an error, with the chart written for dual numbers.
template <class S>
WheelOdometry::Measured<S> moved(const State& x, const Eigen::Matrix<S, 12, 1>& e) {
  FreeCameraMotion::State<S> y = x.cast<S>();
  y.template head<3>() += e.template head<3>();
  const Vector4<S> q = y.template segment<4>(3);
  y.template segment<4>(3) =
      quaternion_product<S>(q, quaternion_exp<S>(Vector3<S>(e.template segment<3>(3))));
  y.template tail<6>() += e.template tail<6>();
  return odometry.h<S>(y);
}

TEST(WheelOdometry, JacobianIsExact) {
  RandomStream random(1, "states");
  for (int i = 0; i < 200; ++i) {
    const State x = drawn(random, i < 100 ? 1 : 20);
    const auto by_error = derivatives<12, 4>(moved<Dual<12>>(x, variables<12>(Error(Error::Zero()))));
    const WheelOdometry::Prediction prediction = odometry.predict_measurement(x);
    EXPECT_LT((prediction.H - by_error).cwiseAbs().maxCoeff(), 1e-10 * (1 + by_error.cwiseAbs().maxCoeff()))
        << i;
    EXPECT_EQ(prediction.z, odometry.h<double>(x));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(prediction.R).eigenvalues()[0], 0);
  }
}

TEST(WheelOdometry, HoldsForAVehicleOnUnevenGround) {
  RandomStream random(2, "vehicles");
  for (const Terrain& ground :
       {grounds::gentle_waves(), grounds::steep_slope(), grounds::small_height_map()}) {
    const TerrainVehicle vehicle{ground};
    for (int i = 0; i < 100; ++i) {
      const TerrainVehicle::State<double> x(random.uniform(-1, 1), random.uniform(-1, 1),
                                            random.uniform(-3, 3));
      const TerrainVehicle::Input<double> u(random.normal(), random.normal());
      const MountedCamera<3> mounted_pose = odometry.mount.on(vehicle.pose(x));
      State camera = mounted_pose.camera;
      camera.tail<6>() = mounted_pose.J * vehicle.rate<double>(x, u);
      EXPECT_LT((odometry.h<double>(camera) - WheelOdometry::measured(u)).norm(), 1e-10);
    }
  }
}

}  // namespace
}  // namespace incognita
