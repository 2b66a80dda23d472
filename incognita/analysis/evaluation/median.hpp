// Median of independent samples with its confidence interval.
#pragma once

#include <vector>

#include "incognita/analysis/evaluation/statistics.hpp"

namespace incognita {

/// Distribution-free interval between two order statistics, from the quantiles of the binomial distribution with n
/// trials and probability 1/2. From -inf to inf for too few samples (five or less at 95 %); NaN for none.
Interval median_interval(std::vector<double> samples, double confidence = usual_confidence);

}  // namespace incognita
