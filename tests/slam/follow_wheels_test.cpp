// Wheels in the camera's filter: an update by what they tell leaves it as sure as it may be, and surer.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "incognita/belief/belief.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/wheel_odometry.hpp"

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

TEST(FollowWheels, LeavesTheFilterAsSureAsItMayBe) {
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
    truth.tail<6>() = gaussian(random, Error::Constant(0.3)).tail<6>();
    State mean = truth;
    Error error = gaussian(random, sigmas);
    FreeCameraMotion::chart.plus(numbers(mean), numbers(error));

    Belief belief;
    const BlockId camera =
        belief.add_vehicle(FreeCameraMotion::chart, mean, sigmas.cwiseAbs2().asDiagonal().toDenseMatrix());
    const WheelOdometry::Look look = odometry.look(mean);
    WheelOdometry::Measured<double> z = odometry.h<double>(truth);
    for (int k = 0; k < 4; ++k) z[k] += std::sqrt(look.R(k, k)) * random.normal();
    AffineLook affine;
    affine.add(camera, look.H);
    affine.residual = z - look.z;
    affine.R = look.R;
    const UpdateReport report = belief.update({&affine, 1});
    nis += report.nis;

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
