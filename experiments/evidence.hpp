// From runs to verdicts: what chance leaves open, and how a claim is judged.
//
// Intervals are 95 % where they are shown. A claim that something equals its prediction is judged at 99.9 %,
// so that a true one seldom fails when the number of runs is another.
#pragma once

#include <string>
#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita {

inline constexpr double shown = 0.95, judged_at = 0.999;

struct Interval {
  double value = 0, low = 0, high = 0;
  bool contains(double x) const { return low <= x && x <= high; }
};

/// Mean of independent samples, by Student's t. Everything from -inf to inf for a single one.
Interval mean_of(const std::vector<double>& samples, double confidence = shown);

/// Mean of independent samples of any distribution, by bootstrap (percentiles of 2000 resamples, always the
/// same). From -inf to inf for fewer than five.
Interval bootstrap_mean(const std::vector<double>& samples, double confidence = shown);

/// Root mean square of independent samples, by chi-square for normal ones about 0.
Interval rms_of(const std::vector<double>& samples, double confidence = shown);

/// b of the least-squares line y = a + b x.
Interval slope_of(const std::vector<double>& x, const std::vector<double>& y, double confidence = shown);

/// Where the mean over runs of a NEES that is divided by its degrees of freedom belongs when the filter is
/// consistent; value 1.
Interval nees_band(int runs, int degrees_of_freedom, double confidence = shown);

/// e of the power law y = c x^e that fits best, by logarithms; y > 0.
double exponent_of(const std::vector<double>& x, const std::vector<double>& y);

/// `0.158 m (0.143 to 0.176)`
std::string text(const Interval& interval, const std::string& unit = "");

/// What is as good as zero, the same on every processor: the power of ten it stays below, `below 1e-9`; 1e-12
/// at least.
std::string below(double difference);

/// The claim with its verdict. `printed`: what the thesis says passed; else `corrected`: what `why` says
/// instead did. Where the claim holds as it is there is nothing to explain, and `why` goes.
Claim judged(Claim claim, bool printed, bool corrected = false);

}  // namespace incognita
