// Wheel odometry as a measurement of the camera.
#include "incognita/slam/mapper/prediction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using State = FreeCameraMotion::State<double>;
using Error = Eigen::Matrix<double, 12, 1>;

std::span<double> numbers(auto& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

Error gaussian(RandomStream& random, const Error& sigmas) {
  Error e;
  for (int i = 0; i < e.size(); ++i) e[i] = sigmas[i] * random.normal();
  return e;
}

/// Velocity and rate of a camera whose axle moves as its wheels turn, but for slip: h() is linear in them,
/// and leaves two of the rates free.
Eigen::Matrix<double, 6, 1> motion_on(const WheelOdometry& odometry, const Eigen::Vector2d& wheels,
                                      State camera, RandomStream& random) {
  const double slip = odometry.sigma_slip_m_s;
  WheelOdometry::Measured<double> axle = WheelOdometry::measured(wheels);
  for (int k = 0; k < 3; ++k) axle[k] += slip * random.normal();
  camera.tail<6>() = gaussian(random, Error::Constant(0.3)).tail<6>();
  const WheelOdometry::Prediction at = odometry.predict_measurement(camera);
  const Eigen::Matrix<double, 4, 6> H = at.H.rightCols<6>();
  return camera.tail<6>() + H.transpose() * (H * H.transpose()).ldlt().solve(axle - at.z);
}

/// The wheels say what the camera's motion is, of an axle that slips: NEES and NIS are those of their degrees
/// of freedom.
TEST(FollowWheels, LeavesTheFilterConsistent) {
  const WheelOdometry odometry{{0.1, 0, 0.8, 0, 0}, 0.05, 0.03, 0.02};
  Error sigmas;
  sigmas << 0.05, 0.05, 0.05, 0.02, 0.02, 0.02, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1;
  RandomStream random(5, "draws");
  constexpr int draws = 2000;
  double nees = 0, nis = 0, variance_ratio = 0;
  for (int i = 0; i < draws; ++i) {
    State truth = State::Zero();
    truth.segment<4>(3) =
        quaternion_exp<double>(Vector3<double>(random.normal(), random.normal(), random.normal()));
    Eigen::Vector2d wheels(0.5 * random.normal(), 0.3 * random.normal());
    truth.tail<6>() = motion_on(odometry, wheels, truth, random);
    State mean = truth;
    Error error = gaussian(random, sigmas);
    FreeCameraMotion::chart.plus(numbers(mean), numbers(error));

    AnyBelief belief;
    const BlockId camera =
        belief.add_vehicle(FreeCameraMotion::chart, mean, sigmas.cwiseAbs2().asDiagonal().toDenseMatrix());
    wheels[0] += odometry.sigma_speed_m_s * random.normal();
    wheels[1] += odometry.sigma_turn_rate_rad_s * random.normal();
    nis += update_with_wheel_odometry(belief, camera, odometry, wheels).nis;

    State after = belief.mean(camera);
    FreeCameraMotion::chart.minus(numbers(truth), numbers(after), numbers(error));
    const Eigen::MatrixXd P = belief.covariance(camera);
    nees += error.dot(P.llt().solve(error));
    variance_ratio += P.diagonal().segment<3>(6).sum() / sigmas.segment<3>(6).squaredNorm();
  }
  // 24000 and 8000 degrees of freedom: standard deviations of 0.9 % and 1.6 %
  EXPECT_NEAR(nees / draws / 12, 1, 0.04);
  EXPECT_NEAR(nis / draws / 4, 1, 0.06);
  EXPECT_LT(variance_ratio / draws, 0.5);
}

}  // namespace
}  // namespace incognita
