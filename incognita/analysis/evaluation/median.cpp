#include "incognita/analysis/evaluation/median.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <limits>

namespace incognita {

Interval median_interval(std::vector<double> samples, double confidence) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double median = median_of(samples);
  if (samples.empty()) return {median, -inf, inf};
  std::sort(samples.begin(), samples.end());
  const boost::math::binomial half(static_cast<double>(samples.size()), 0.5);
  std::size_t beyond = 0;  // samples beyond the interval at each end
  while (cdf(half, static_cast<double>(beyond)) <= (1 - confidence) / 2) ++beyond;
  if (beyond == 0) return {median, -inf, inf};
  return {median, samples[beyond - 1], samples[samples.size() - beyond]};
}

}  // namespace incognita
