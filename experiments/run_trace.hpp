// A planar vehicle over a run, as the loop gives it tick by tick, and a recording given to the estimator.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "experiments/processor_time.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/world/replay/recorded_ranges.hpp"

namespace incognita {

struct PoseInstant {
  planar::Pose<double> truth, mean;
  Eigen::Matrix3d covariance;
  Eigen::Vector2d input = Eigen::Vector2d::Zero();  ///< commanded, until the next tick

  /// truth less mean; heading within half a turn
  planar::Pose<double> error() const {
    planar::Pose<double> e = truth - mean;
    e[2] = wrap_angle(e[2]);
    return e;
  }
  /// Of the pose, divided by 3.
  double nees() const { return error().dot(covariance.llt().solve(error())) / 3; }
};

struct RunTrace {
  std::vector<double> t_s;
  std::vector<PoseInstant> instants;

  void add(double t, const PoseInstant& now) { t_s.push_back(t), instants.push_back(now); }
  double position_rms_m() const {
    return std::sqrt(mean([](const PoseInstant& i) { return i.error().head<2>().squaredNorm(); }));
  }
  double heading_rms_rad() const {
    return std::sqrt(mean([](const PoseInstant& i) { return i.error()[2] * i.error()[2]; }));
  }
  double mean_nees() const {
    return mean([](const PoseInstant& i) { return i.nees(); });
  }

 private:
  template <class Of>
  double mean(const Of& of) const {
    double sum = 0;
    for (const PoseInstant& i : instants) sum += of(i);
    return sum / static_cast<double>(instants.size());
  }
};

/// Gives a recording to an estimator and calls `visit(estimate, tick)` after each tick; returns the last
/// estimate. The time that updates take is added to `took_s`, unless it is null.
template <class Visit>
Estimate replay(const SharedRangeRecordings& recordings, double duration_s,
                const RangeSensorSettings& settings, const EstimatorSettings& filter, const Visit& visit,
                double* took_s = nullptr) {
  ReplayClock clock(scan_times(*recordings, duration_s));
  SensorSet sensors = recorded_ranges(recordings, settings);
  SlamEstimator estimator(filter);
  Estimate estimate;
  while (const Tick tick = clock.next()) {
    const Observation observation = sensors.measure({}, tick);
    const double before_s = processor_seconds();
    estimator.update(estimate, {}, observation, tick);
    if (took_s) *took_s += processor_seconds() - before_s;
    visit(estimate, tick);
  }
  return estimate;
}

}  // namespace incognita
