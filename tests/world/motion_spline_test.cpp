#include "incognita/world/motion_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

/// A smooth motion with rotations about all axes, known at all times.
RigidPose along(double t) {
  const Eigen::Vector3d turn(0.4 * std::sin(1.3 * t), 0.3 * std::cos(t), 0.8 * t);
  return {{std::sin(t), 0.5 * std::cos(2 * t), 0.2 * t}, quaternion_exp<double>(turn)};
}

std::vector<TimedPose> sampled(double dt, double from = 0, double to = 4) {
  std::vector<TimedPose> samples;
  for (double t = from; t < to; t += dt) samples.push_back({t, along(t)});
  return samples;
}

double angle_between(const RigidPose& a, const RigidPose& b) {
  return quaternion_log<double>(
             quaternion_product<double>(quaternion_conjugate<double>(a.world_from_body), b.world_from_body))
      .norm();
}

TEST(MotionSpline, HitsTheSamples) {
  RandomStream random(1, "samples");
  std::vector<TimedPose> samples;
  for (double t = 0; t < 3; t += random.uniform(0.02, 0.4)) {
    samples.push_back({t, along(t)});
    samples.back().pose.position += 0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    if (samples.size() % 2) samples.back().pose.world_from_body *= -1;  // the same orientation
  }
  const MotionSpline spline(samples);
  for (const TimedPose& sample : samples) {
    const RigidPose at = spline.at(sample.t).pose;
    EXPECT_LT((at.position - sample.pose.position).norm(), 1e-12) << sample.t;
    EXPECT_LT(angle_between(at, sample.pose), 1e-9) << sample.t;
  }
}

/// Halving the interval divides the error of a cubic with estimated slopes by eight.
TEST(MotionSpline, ConvergesToASmoothMotion) {
  double last_position = 0, last_angle = 0;
  for (const double dt : {0.1, 0.05, 0.025}) {
    const MotionSpline spline(sampled(dt));
    double position = 0, angle = 0;
    for (double t = 1; t < 3; t += 0.0013) {
      position = std::max(position, (spline.at(t).pose.position - along(t).position).norm());
      angle = std::max(angle, angle_between(spline.at(t).pose, along(t)));
    }
    if (last_position > 0) {
      EXPECT_LT(position, last_position / 6);
      EXPECT_LT(angle, last_angle / 6);
    }
    last_position = position, last_angle = angle;
  }
  EXPECT_LT(last_position, 1e-5);
  EXPECT_LT(last_angle, 1e-5);
}

TEST(MotionSpline, VelocityAndRateAreTheDerivativesOfThePose) {
  const MotionSpline spline(sampled(0.1));
  constexpr double h = 1e-5;
  for (double t = -0.2; t < 4.3; t += 0.0171) {
    const MovingPose now = spline.at(t);
    const RigidPose before = spline.at(t - h).pose, after = spline.at(t + h).pose;
    EXPECT_LT(((after.position - before.position) / (2 * h) - now.velocity).norm(), 1e-6) << t;
    const Eigen::Vector4d turned = quaternion_product<double>(
        quaternion_conjugate<double>(before.world_from_body), after.world_from_body);
    EXPECT_LT((quaternion_log<double>(turned) / (2 * h) - now.rate).norm(), 1e-6) << t;
  }
}

TEST(MotionSpline, VelocityAndRateAreContinuous) {
  const std::vector<TimedPose> samples = sampled(0.13);
  const MotionSpline spline(samples);
  for (const TimedPose& sample : samples) {
    const MovingPose before = spline.at(sample.t - 1e-9), after = spline.at(sample.t + 1e-9);
    EXPECT_LT((before.velocity - after.velocity).norm(), 1e-6) << sample.t;
    EXPECT_LT((before.rate - after.rate).norm(), 1e-6) << sample.t;
  }
}

TEST(MotionSpline, GoesOnSteadilyBeyondItsEnds) {
  const MotionSpline spline(sampled(0.1));
  for (const auto& [end, direction] : {std::pair(spline.first_s(), -1.0), {spline.last_s(), 1.0}}) {
    const MovingPose at_end = spline.at(end), beyond = spline.at(end + 0.3 * direction);
    EXPECT_EQ(beyond.velocity, at_end.velocity);
    const RigidPose expected = extrapolated(at_end, 0.3 * direction);
    EXPECT_LT((beyond.pose.position - expected.position).norm(), 1e-12);
    EXPECT_LT(angle_between(beyond.pose, expected), 1e-9);
  }
  EXPECT_EQ(extrapolated(spline.at(1), 0).world_from_body, spline.at(1).pose.world_from_body);
}

TEST(MotionSpline, RefusesWhatIsNoMotion) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MotionSpline({}), std::invalid_argument);
  EXPECT_THROW(MotionSpline({{0, along(0)}}), std::invalid_argument);
  EXPECT_THROW(MotionSpline({{0, along(0)}, {0, along(1)}}), std::invalid_argument);
  EXPECT_THROW(MotionSpline({{1, along(0)}, {0, along(1)}}), std::invalid_argument);
  EXPECT_THROW(MotionSpline({{0, along(0)}, {nan, along(1)}}), std::invalid_argument);
  EXPECT_THROW(MotionSpline({{0, along(0)}, {1, along(nan)}}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
