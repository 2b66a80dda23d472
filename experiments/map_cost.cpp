#include "experiments/map_cost.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "experiments/processor_time.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita {
namespace {

constexpr int measurements_per_step = 10, steps = 60;

void one_step(Belief& belief, int landmarks, int step, std::vector<LinearizedMeasurement>& measurements) {
  const DifferentialDrive drive;
  const auto moved = drive.step(belief.mean(0), {0, 0.01}, 1);
  belief.predict({0, moved.x, moved.F, 1e-6 * Eigen::Matrix3d::Identity()});
  measurements.clear();
  for (int i = 0; i < measurements_per_step; ++i) {
    const BlockId id = 1 + (step * measurements_per_step + i) % landmarks;  // after the vehicle's
    const auto prediction = RangeBearing::predict_measurement(belief.mean(0), belief.mean(id));
    LinearizedMeasurement& measurement = measurements.emplace_back();
    measurement.add(0, prediction->Hv);
    measurement.add(id, prediction->Hl);
    measurement.residual = Eigen::Vector2d::Zero();
    measurement.R = 1e-2 * Eigen::Matrix2d::Identity();
  }
  belief.update(measurements);
}

}  // namespace

Belief belief_with_landmarks(int landmarks, MapCorrelations correlations) {
  Belief belief(3 + 2 * landmarks, correlations);
  const planar::Pose<double> pose(0, 0, 0);
  const BlockId vehicle = belief.add_vehicle(planar::pose_chart, pose, 1e-4 * Eigen::Matrix3d::Identity());
  for (int i = 0; i < landmarks; ++i) {
    const auto initialized = RangeBearing::initialize(pose, {5 + 0.01 * i, 6.28 * i / landmarks - 3.14});
    const Belief::Parent parent{vehicle, initialized.Jv};
    belief.augment(RangeBearing::landmark_chart, initialized.landmark, {&parent, 1},
                   1e-2 * Eigen::Matrix2d::Identity());
  }
  return belief;
}

double step_seconds(int landmarks, MapCorrelations correlations) {
  Belief belief = belief_with_landmarks(landmarks, correlations);
  std::vector<LinearizedMeasurement> measurements;
  double fastest = std::numeric_limits<double>::infinity();
  for (int step = 0; step < steps; ++step) {
    const double start = processor_seconds();
    one_step(belief, landmarks, step, measurements);
    fastest = std::min(fastest, processor_seconds() - start);
  }
  return fastest;
}

}  // namespace incognita
