#include "incognita/models/motion/free_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using State = FreeCameraMotion::State<double>;
using Input = FreeCameraMotion::Input<double>;

const FreeCameraMotion motion;

State at_rest() {
  State x = State::Zero();
  x[3] = 1;
  return x;
}

TEST(FreeCameraMotion, TranslatesWithTheNewVelocity) {  // (5.24)
  State x = at_rest();
  x.segment<3>(7) << 1, -2, 0.5;
  Input u = Input::Zero();
  u.head<3>() << 0, 0, -10;
  const State y = motion.f<double>(x, u, 0.1);
  EXPECT_LT((y.segment<3>(7) - Vector3d(1, -2, -0.5)).norm(), 1e-15);
  EXPECT_LT((y.segment<3>(0) - Vector3d(0.1, -0.2, -0.05)).norm(), 1e-15);
  EXPECT_EQ(y.segment<4>(3), Vector4d(1, 0, 0, 0));
}

TEST(FreeCameraMotion, RotatesAboutItsOwnAxes) {
  State x = at_rest();
  x.segment<4>(3) = quaternion_exp<double>(Vector3d(0, 0, std::numbers::pi / 2));  // camera x is world y
  x.segment<3>(10) << 0.3, 0, 0;
  const State y = motion.f<double>(x, Input::Zero(), 1);
  const Vector4d about_world_y =
      quaternion_product<double>(quaternion_exp<double>(Vector3d(0, 0.3, 0)), x.segment<4>(3));
  EXPECT_LT((y.segment<4>(3) - about_world_y).norm(), 1e-15);
}

TEST(FreeCameraMotion, TwoStepsWithoutInputEqualOne) {
  RandomStream random(1, "two steps");
  for (int i = 0; i < 100; ++i) {
    State x;
    for (double& number : x) number = random.normal();
    x.segment<4>(3).normalize();
    const State once = motion.f<double>(x, Input::Zero(), 0.3);
    const State twice = motion.f<double>(motion.f<double>(x, Input::Zero(), 0.1), Input::Zero(), 0.2);
    EXPECT_LT((once - twice).norm(), 4e-15);
  }
}

TEST(FreeCameraMotion, IsInvariantToRigidTransformations) {
  RandomStream random(1, "symmetry");
  State x;
  for (double& number : x) number = random.normal();
  x.segment<4>(3).normalize();
  Input u;
  for (double& number : u) number = random.normal();
  State moved = x;
  moved.segment<3>(0) += Vector3d(5, -7, 1);
  moved.segment<4>(3) =
      quaternion_product<double>(quaternion_exp<double>(Vector3d(1, 0.5, -2)), x.segment<4>(3));
  const auto here = motion.step(x, u, 0.1), there = motion.step(moved, u, 0.1);
  EXPECT_EQ(here.F, there.F);
  EXPECT_EQ(here.G, there.G);
}

TEST(FreeCameraMotion, QuaternionStaysUnitForAnHourOfFrames) {
  RandomStream random(1, "hour");
  State x = at_rest();
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    Input u;
    for (double& number : u) number = random.normal();
    u.tail<3>() -= x.segment<3>(10);  // as a controller would, so that the rate stays bounded
    x = motion.f<double>(x, u, 1.0 / 30);
    worst = std::max(worst, std::abs(x.segment<4>(3).norm() - 1));
  }
  EXPECT_LT(worst, 1e-15);
}

}  // namespace
}  // namespace incognita
