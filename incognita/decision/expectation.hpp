// Interface of the prediction of measurements from a hypothetical state.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/predicted_measurement.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class Expectation {
 public:
  virtual ~Expectation() = default;
  /// Replaces `measurements` by those predicted for the body in `state`.
  virtual void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const = 0;
};

/// The measurements that one sensor of one body will make of the current map.
class SensorExpectation {
 public:
  virtual ~SensorExpectation() = default;
  /// Sets the map and the landmarks that are expected but not mapped; both must outlive the calls until the next
  /// prepare().
  virtual void prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen,
                       double unseen_var_m2) = 0;
  /// Adds the measurements predicted for the body in `state`.
  virtual void add(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const = 0;
  /// Whether the sensor would measure a landmark at `position` (world, m) from `state` of its body.
  virtual bool in_view(const BlockVector& state, const Eigen::Vector3d& position) const = 0;
};

/// The measurements that all sensors of a body will make together.
class MapExpectation final : public Expectation {
 public:
  using OfBody = std::vector<std::unique_ptr<SensorExpectation>>;
  explicit MapExpectation(std::vector<OfBody> bodies) : bodies_(std::move(bodies)) {}

  /// As SensorExpectation::prepare(); expect() is then that of `body`.
  void prepare(const Estimate& estimate, std::size_t body, const std::vector<ExpectedLandmark>& unseen,
               double unseen_var_m2);
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;
  /// Whether any sensor of the body would measure a landmark at `position` (world, m) from `state`.
  bool in_view(std::size_t body, const BlockVector& state, const Eigen::Vector3d& position) const;

 private:
  std::vector<OfBody> bodies_;
  std::size_t body_ = 0;
};

/// The smallest of the `most` largest traces of the innovation covariances (e.g. px^2), i.e. the threshold of a
/// search limited to `most` measurements. Minus infinity if there are no more than `most`. `sorted` is scratch.
double least_of_the_best(const std::vector<double>& traces, int most, std::vector<double>& sorted);

}  // namespace incognita
