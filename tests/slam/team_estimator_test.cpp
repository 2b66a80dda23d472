// The team estimator by hand-made observations: what a tick costs the heap.
#include "incognita/slam/estimator/slam_estimator.hpp"

#include <gtest/gtest.h>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "tests/allocations.hpp"

namespace incognita::testing {
namespace {

/// Vehicles side by side that go straight on, among points that all see; and each sees the others.
struct Convoy {
  EstimatorSettings settings;
  std::vector<planar::Pose<double>> truth;
  std::vector<Eigen::Vector2d> points;
  std::int64_t frame = 0;

  Convoy(int vehicles, int landmarks) {
    for (int i = 0; i < vehicles; ++i) {
      truth.emplace_back(0, 3.0 * i, 0);
      settings.bodies.push_back(body_with_sensor(
          DifferentialDrive{}, RangeBearingSensor{}, truth.back(), Eigen::Vector3d::Constant(0.01),
          Eigen::Vector2d::Constant(0.05), Eigen::Vector2d(0.1, 0.02)));
    }
    for (int i = 0; i < landmarks; ++i) points.emplace_back(4 + 2.0 * i, i % 2 ? -2 : 5);
    settings.filter.gate_probability = 0.999;
  }

  Observation next() {
    Observation observation;
    for (planar::Pose<double>& x : truth) {
      BodyObservation view;
      view.input = Eigen::Vector2d(0.5, 0);
      if (frame > 0) x = DifferentialDrive{}.f<double>(x, Eigen::Vector2d(*view.input), 0.1);
      for (std::size_t i = 0; i < points.size(); ++i)
        view.landmarks.push_back({static_cast<std::int64_t>(i), RangeBearing::h<double>(x, points[i])});
      for (std::size_t i = 0; i < truth.size(); ++i)
        if (&truth[i] != &x)
          view.vehicles.push_back({static_cast<std::int64_t>(i),
                                   RangeBearing::h<double>(x, Eigen::Vector2d(truth[i].head<2>()))});
      observation.bodies.push_back(view);
    }
    return observation;
  }
  Tick tick() {
    const double t = 0.1 * static_cast<double>(frame);
    return {frame, t, frame++ > 0 ? 0.1 : 0.0};
  }
};

/// How many of 100 ticks are doubted where sightings are so many times as noisy as believed.
int doubted(double noise) {
  Convoy convoy(2, 6);
  convoy.settings.filter.gate_probability = 1;
  SlamEstimator estimator(convoy.settings);
  Estimate estimate;
  RandomStream random(5, "sightings");
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    Observation observation = convoy.next();
    for (BodyObservation& view : observation.bodies)
      for (auto* detections : {&view.landmarks, &view.vehicles})
        for (PointDetection& s : *detections)
          for (int k = 0; k < 2; ++k)
            s.z[k] += noise * convoy.settings.bodies[0].sensors[0].sigmas[k] * random.normal();
    estimator.update(estimate, {}, observation, convoy.tick());
    if (estimate.status.state != TrackingState::degraded) continue;
    ++count;
    EXPECT_NE(estimate.status.reason.find("sigma rms"), std::string::npos) << estimate.status.reason;
  }
  return count;
}

TEST(SlamEstimator, IsDegradedByLargeInnovations) {
  EXPECT_EQ(doubted(1), 0);
  EXPECT_EQ(doubted(1.5), 0) << "noises are never known that well";
  EXPECT_GT(doubted(4), 80);
}

class TeamAllocation : public Allocation {};

TEST_F(TeamAllocation, NeverHappensInTheLoop) {
  Convoy convoy(4, 12);
  SlamEstimator estimator(convoy.settings);
  Estimate estimate;
  for (int i = 0; i < 3; ++i) {  // births, then the first update
    const Observation observation = convoy.next();
    estimator.update(estimate, {}, observation, convoy.tick());
  }
  for (int i = 0; i < 5; ++i) {
    const Observation observation = convoy.next();
    const Tick tick = convoy.tick();
    EXPECT_EQ(allocations_in([&] { estimator.update(estimate, {}, observation, tick); }), 0);
    EXPECT_EQ(estimate.last.matched, 4 * (12 + 3));
  }
}

}  // namespace
}  // namespace incognita::testing
