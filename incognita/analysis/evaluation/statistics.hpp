// What many runs say, and what chance leaves open: means and shares with their intervals.
//
// An interval that is told to people holds the truth in 95 of 100 repetitions unless said otherwise. Where
// the samples are too few for one it reaches from -inf to inf.
#pragma once

#include <cstddef>
#include <vector>

namespace incognita {

inline constexpr double usual_confidence = 0.95;

struct Interval {
  double value = 0, low = 0, high = 0;
  bool contains(double x) const { return low <= x && x <= high; }
};

/// Mean of independent samples, by Student's t. Everything from -inf to inf for a single one.
Interval mean_of(const std::vector<double>& samples, double confidence = usual_confidence);

/// Mean of independent samples of any distribution, by bootstrap (percentiles of 2000 resamples or more,
/// always the same). From -inf to inf for fewer than five.
Interval bootstrap_mean(const std::vector<double>& samples, double confidence = usual_confidence);

/// Root mean square of independent samples, by chi-square for normal ones about 0.
Interval rms_of(const std::vector<double>& samples, double confidence = usual_confidence);

/// How often something happens that did `count` times in `of` independent trials, by Wilson's score: within 0
/// and 1, and of some width even where it never happened. From 0 to 1, value NaN, of no trial.
Interval share_of(std::size_t count, std::size_t of, double confidence = usual_confidence);

/// The middle one, between the middle two of an even number. NaN without samples.
double median_of(std::vector<double> samples);

/// b of the least-squares line y = a + b x.
Interval slope_of(const std::vector<double>& x, const std::vector<double>& y,
                  double confidence = usual_confidence);

/// Where the mean over runs of a NEES that is divided by its degrees of freedom belongs when the filter is
/// consistent; value 1.
Interval nees_band(int runs, int degrees_of_freedom, double confidence = usual_confidence);

/// e of the power law y = c x^e that fits best, by logarithms; y > 0.
double exponent_of(const std::vector<double>& x, const std::vector<double>& y);

/// Two ways to do the same, compared on the same seeds.
struct PairedComparison {
  std::size_t pairs = 0;
  Interval difference;  ///< mean of sample less reference, by bootstrap_mean(); value NaN without pairs
  double share_lower =
      0;  ///< of the pairs in which the sample is lower than its reference; NaN without pairs
  double share_higher = 0;
};

/// Entry i of both is of the same seed. A pair with a NaN is left out.
PairedComparison compare_pairs(const std::vector<double>& samples, const std::vector<double>& reference);

}  // namespace incognita
