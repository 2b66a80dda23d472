// Statistics over many runs: means and proportions with confidence intervals.
//
// The confidence is 95 % unless stated otherwise. With too few samples the interval is from -inf to inf.
#pragma once

#include <cstddef>
#include <vector>

namespace incognita {

inline constexpr double usual_confidence = 0.95;

struct Interval {
  double value = 0, low = 0, high = 0;
  bool contains(double x) const { return low <= x && x <= high; }
};

/// Mean of independent samples with Student's t interval; from -inf to inf for a single sample.
Interval mean_of(const std::vector<double>& samples, double confidence = usual_confidence);

/// Mean of independent samples of any distribution, by bootstrap (percentiles of at least 2000 resamples,
/// deterministic). From -inf to inf for fewer than five.
Interval bootstrap_mean(const std::vector<double>& samples, double confidence = usual_confidence);

/// Root mean square of independent samples, with the chi-square interval of zero-mean normal samples.
Interval rms_of(const std::vector<double>& samples, double confidence = usual_confidence);

/// Proportion of `count` events in `of` independent trials, with Wilson's score interval: within 0 and 1, and
/// of nonzero width even without events. From 0 to 1 with value NaN for no trial.
Interval share_of(std::size_t count, std::size_t of, double confidence = usual_confidence);

/// Median; the mean of the middle two for an even number. NaN without samples.
double median_of(std::vector<double> samples);

/// Slope b of the least-squares line y = a + b x.
Interval slope_of(const std::vector<double>& x, const std::vector<double>& y,
                  double confidence = usual_confidence);

/// Acceptance region of the mean over runs of a NEES divided by its degrees of freedom, if the filter is
/// consistent; value 1.
Interval nees_band(int runs, int degrees_of_freedom, double confidence = usual_confidence);

/// Exponent e of the power law y = c x^e fitted in logarithms; y > 0.
double exponent_of(const std::vector<double>& x, const std::vector<double>& y);

/// Comparison of two methods on the same seeds.
struct PairedComparison {
  std::size_t pairs = 0;
  Interval difference;     ///< mean of sample minus reference, by bootstrap_mean(); value NaN without pairs
  double share_lower = 0;  ///< fraction of pairs with sample < reference; NaN without pairs
  double share_higher = 0;
};

/// Entry i of both has the same seed. Pairs with a NaN are skipped.
PairedComparison compare_pairs(const std::vector<double>& samples, const std::vector<double>& reference);

}  // namespace incognita
