// Interface of the prediction of measurements from a hypothetical state.
#pragma once

#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/predicted_measurement.hpp"

namespace incognita {

class Expectation {
 public:
  virtual ~Expectation() = default;
  /// Replaces `measurements` by those predicted for the vehicle in `state`.
  virtual void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const = 0;
};

/// The smallest of the `most` largest traces of the innovation covariances (e.g. px^2), i.e. the threshold of a
/// search limited to `most` measurements. Minus infinity if there are no more than `most`. `sorted` is scratch.
double least_of_the_best(const std::vector<double>& traces, int most, std::vector<double>& sorted);

}  // namespace incognita
