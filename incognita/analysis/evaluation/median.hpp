// The median of independent samples and what chance leaves open of it.
#pragma once

#include <vector>

#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita {

/// Between two of the samples, so many from either end that a binomial of n trials and 1/2 falls short of
/// them with half of what the confidence leaves; of any distribution. From -inf to inf where the samples are
/// too few, five or less at 95 %; NaN for none.
Interval median_interval(std::vector<double> samples, double confidence = usual_confidence);

}  // namespace incognita
