// Interface of the prediction of measurements from a hypothetical state.
#pragma once

#include <cstddef>
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

/// The measurements that the sensors of a body will make of the current map.
class MapExpectation : public Expectation {
 public:
  /// Sets the body, the map and the landmarks that are expected but not mapped; estimate and landmarks must outlive the
  /// calls until the next prepare().
  virtual void prepare(const Estimate& estimate, std::size_t body,
                       const std::vector<ExpectedLandmark>& unseen, double unseen_var_m2) = 0;
  /// Whether the body would measure a landmark at `position` (world, m) from `state`.
  virtual bool in_view(std::size_t body, const BlockVector& state, const Eigen::Vector3d& position) const = 0;
};

/// The smallest of the `most` largest traces of the innovation covariances (e.g. px^2), i.e. the threshold of a
/// search limited to `most` measurements. Minus infinity if there are no more than `most`. `sorted` is scratch.
double least_of_the_best(const std::vector<double>& traces, int most, std::vector<double>& sorted);

}  // namespace incognita
