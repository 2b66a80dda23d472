// What a vehicle of a team sees of another, and of landmarks, as the filter takes it: predictions and
// Jacobians by both against differences of the belief's means.
#include "incognita/slam/mapper/measurements.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
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

TEST(TeamLooks, OfAnotherVehicleAreDerivedByBothInAnyPlace) {
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

}  // namespace
}  // namespace incognita
