// What would be seen from where nobody is yet.
#pragma once

#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/predicted_measurement.hpp"

namespace incognita {

class Expectation {
 public:
  virtual ~Expectation() = default;
  /// Replaces `looks` by what would be seen with the vehicle in that state.
  virtual void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const = 0;
};

/// The smallest of the `most` largest traces, which a search for so many looks would take: those of the
/// covariance of what is expected, px^2 or so. Minus infinity where there are no more than that. `sorted` is
/// scratch.
double least_of_the_best(const std::vector<double>& traces, int most, std::vector<double>& sorted);

}  // namespace incognita
