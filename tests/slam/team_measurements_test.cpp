// Measurements of a team, as the filter linearizes them: Jacobians with respect to both bodies against differences of the
// means, and the measurements that are too nonlinear to be used.
#include "incognita/slam/mapper/measurements.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "tests/small_vectors.hpp"

namespace incognita {
namespace {

using testing::minus;
using testing::plus;
using testing::vec;

struct Pair {
  EstimatorSettings settings;
  Estimate estimate;
};

/// Two vehicles that know where they are; the second is in view of the first.
Pair pair_of(const AnyMotion& motion, const AnySensor& sensor, const SmallVector& first,
             const SmallVector& second) {
  Pair pair;
  for (const SmallVector& start : {first, second}) {
    const int errors = chart_of(motion).tangent(), numbers = chart_of(sensor).tangent();
    pair.settings.bodies.push_back(body_with_sensor(motion, sensor, start, SmallVector::Constant(errors, 0.1),
                                                    SmallVector::Constant(inputs_of(motion), 0.1),
                                                    SmallVector::Constant(numbers, 1)));
  }
  SlamEstimator estimator(pair.settings);
  Observation nothing;
  nothing.bodies.resize(2);
  estimator.update(pair.estimate, {}, nothing, {0, 0, 0});
  return pair;
}

/// d(prediction) / d(error of a block), by moving the belief's mean.
SmallMatrix differences(Pair pair, BlockId block, const Chart& of, const PointDetection& detection) {
  const Chart& to = chart_of(pair.settings.bodies[0].sensors[0].sensor);
  const SmallVector mean = pair.estimate.belief.mean(block);
  SmallMatrix J(to.tangent(), of.tangent());
  constexpr double h = 1e-5;
  for (int k = 0; k < of.tangent(); ++k) {
    const auto at = [&](double by) -> SmallVector {
      pair.estimate.belief.set_mean(block, plus(of, mean, by * SmallVector::Unit(of.tangent(), k)));
      return linearize_detection(pair.estimate, 0, true, detection, pair.settings)->predicted;
    };
    J.col(k) = minus(to, at(h), at(-h)) / (2 * h);
  }
  return J;
}

TEST(TeamMeasurements, OfAnotherVehicleHaveJacobiansWithRespectToBoth) {
  WideAngleCamera lens;
  const Mount mount{.forward_m = 0.1, .up_m = 0.7};
  const SmallVector here = vec({0, 0, 0.1}), there = vec({4, 1, 2});
  const AnyMotion terrain = TerrainVehicle{Waves{0, {{0.15, 6, 0.3, 0}}}};
  const SmallVector body = vec({0, 0, 0, 0.5, -0.5, 0.5, -0.5, 0, 0, 0, 0, 0, 0});
  SmallVector other = body;
  other.head<3>() << 5, 1, 0.5;
  const AnySensor camera = CameraSensor{Camera(lens), mount},
                  stereo = StereoSensor{{Camera(lens), 0.2}, mount};
  for (const Pair& pair :
       {pair_of(DifferentialDrive{0.2, 0}, RangeBearingSensor{}, here, there),
        pair_of(DifferentialDrive{0.2, 0}, BearingSensor{}, here, there),
        pair_of(MonobotMotion{}, RelativePositionSensor{}, vec({1}), vec({3})),
        pair_of(DifferentialDrive{0.2, 0}, camera, here, there), pair_of(AckermannCar{}, stereo, here, there),
        pair_of(terrain, stereo, here, there), pair_of(FreeCameraMotion{}, camera, body, other),
        pair_of(FreeCameraMotion{}, stereo, body, other)}) {
    const AnyMotion& motion = pair.settings.bodies[0].motion;
    const AnySensor& sensor = pair.settings.bodies[0].sensors[0].sensor;
    SCOPED_TRACE(std::to_string(motion.index()) + " " + std::to_string(sensor.index()));
    PointDetection detection{1, SmallVector::Zero(chart_of(sensor).tangent())};
    const auto of_body = linearize_detection(pair.estimate, 0, true, detection, pair.settings);
    ASSERT_TRUE(of_body);
    ASSERT_EQ(of_body->linearized.part_count, 2);
    const auto wanted =
        predict_measurement(sensor, motion, pair.estimate.belief.mean(pair.estimate.bodies[0].block), {},
                            pose_of(motion, pair.estimate.belief.mean(pair.estimate.bodies[1].block))
                                .position.head(dimensions_of(sensor)));
    EXPECT_LE((of_body->predicted - wanted->z).norm(), 1e-12) << "the other body as a landmark";
    for (int part = 0; part < 2; ++part) {
      const auto& by = of_body->linearized.parts[static_cast<std::size_t>(part)];
      ASSERT_EQ(by.block, pair.estimate.bodies[static_cast<std::size_t>(part)].block);
      const SmallMatrix found = differences(pair, by.block, chart_of(motion), detection);
      EXPECT_LE((by.H - found).norm(), 1e-5 * found.norm()) << by.H << "\n\n" << found;
    }
  }
}

/// The first vehicle initializes a landmark ahead of it by its bearing alone: the depth is unknown.
Pair pair_with_unknown_depth(const SmallVector& second) {
  const AnyMotion motion = DifferentialDrive{0.2, 0};
  Pair pair = pair_of(motion, BearingSensor{}, vec({0, 0, 0}), second);
  for (BodyModel& body : pair.settings.bodies) body.sensors[0].sigmas.setConstant(0.01);
  EXPECT_TRUE(initialize_from_detection(pair.estimate, 0, {7, vec({0.0})}, pair.settings));
  return pair;
}

TEST(TeamMeasurements, OfUnknownDepthAreUsedNearTheRayOfTheirInitializationOnly) {
  const PointDetection detection{7, vec({-0.5})};
  const auto is_used = [&](const SmallVector& second, int body) {
    const Pair pair = pair_with_unknown_depth(second);
    return linearize_detection(pair.estimate, body, false, detection, pair.settings).value().is_linear;
  };
  EXPECT_TRUE(is_used(vec({0, 4, 0}), 0)) << "the body that initialized it";
  EXPECT_FALSE(is_used(vec({0, 4, 0}), 1))
      << "4 m beside the ray: its bearing may be anything from -90 to 0 deg";
  EXPECT_TRUE(is_used(vec({0, 0.05, 0}), 1)) << "5 cm beside it";
  EXPECT_TRUE(is_used(vec({-1, 0, 0}), 1)) << "on the ray, behind";
  EXPECT_TRUE(is_used(vec({2.5, 0, 0}), 1)) << "on the ray, where the landmark may be behind";
}

TEST(TeamMeasurements, OfUnknownDepthAreUsedOnceTheDepthIsKnown) {
  Pair pair = pair_with_unknown_depth(vec({0, 4, 0}));
  const PointDetection detection{7, vec({-0.5})};
  ASSERT_FALSE(linearize_detection(pair.estimate, 1, false, detection, pair.settings)->is_linear);
  const Landmark& landmark = pair.estimate.landmarks.at(7);
  const auto depth = pair.estimate.belief.mean(landmark.block).size() - 1;
  LinearizedMeasurement known;  // of the inverse depth
  known.add(landmark.block, SmallMatrix(SmallVector::Unit(depth + 1, depth).transpose()));
  known.residual = vec({0.0});
  known.R = SmallMatrix::Constant(1, 1, 1e-6);
  pair.estimate.belief.update({&known, 1});
  EXPECT_TRUE(linearize_detection(pair.estimate, 1, false, detection, pair.settings)->is_linear);
}

}  // namespace
}  // namespace incognita
