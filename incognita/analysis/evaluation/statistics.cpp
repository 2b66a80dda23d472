#include "incognita/analysis/evaluation/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using boost::math::chi_squared;
using boost::math::students_t;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double mean(const std::vector<double>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

Interval student(double value, double standard_error, double degrees_of_freedom, double confidence) {
  if (degrees_of_freedom < 1) return {value, -inf, inf};
  const double t = quantile(students_t(degrees_of_freedom), (1 + confidence) / 2);
  return {value, value - t * standard_error, value + t * standard_error};
}

}  // namespace

Interval mean_of(const std::vector<double>& samples, double confidence) {
  const double m = mean(samples), n = static_cast<double>(samples.size());
  double squares = 0;
  for (const double x : samples) squares += (x - m) * (x - m);
  return student(m, n > 1 ? std::sqrt(squares / (n - 1) / n) : 0, n - 1, confidence);
}

Interval bootstrap_mean(const std::vector<double>& samples, double confidence) {
  // At least ten resamples beyond each end
  const int resamples = std::max(2000, static_cast<int>(std::lround(20 / (1 - confidence))));
  constexpr std::size_t fewest = 5;  // fewer samples do not represent the spread
  if (samples.size() < fewest) return {mean(samples), -inf, inf};
  RandomStream random(1, "bootstrap");
  std::vector<double> means;
  for (int r = 0; r < resamples; ++r) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      sum += samples[static_cast<std::size_t>(random.below(static_cast<int>(samples.size())))];
    means.push_back(sum / static_cast<double>(samples.size()));
  }
  std::sort(means.begin(), means.end());
  const auto beyond = static_cast<std::size_t>((1 - confidence) / 2 * (resamples - 1));  // at each end
  return {mean(samples), means[beyond], means[means.size() - 1 - beyond]};
}

Interval rms_of(const std::vector<double>& samples, double confidence) {
  const double n = static_cast<double>(samples.size());
  const double squares = std::inner_product(samples.begin(), samples.end(), samples.begin(), 0.0);
  const chi_squared spread(n);
  return {std::sqrt(squares / n), std::sqrt(squares / quantile(spread, (1 + confidence) / 2)),
          std::sqrt(squares / quantile(spread, (1 - confidence) / 2))};
}

Interval share_of(std::size_t count, std::size_t of, double confidence) {
  if (of == 0) return {unknown, 0, 1};
  const double n = static_cast<double>(of), p = static_cast<double>(count) / n;
  const double z = quantile(boost::math::normal(), (1 + confidence) / 2), zz = z * z / n;
  const double center = (p + zz / 2) / (1 + zz);
  const double half = z / (1 + zz) * std::sqrt(p * (1 - p) / n + zz / (4 * n));
  // Exactly 0 and 1 at the ends, despite rounding
  return {p, count == 0 ? 0 : center - half, count == of ? 1 : center + half};
}

double median_of(std::vector<double> samples) {
  if (samples.empty()) return unknown;
  std::sort(samples.begin(), samples.end());
  const std::size_t n = samples.size();
  return n % 2 == 1 ? samples[n / 2] : 0.5 * (samples[n / 2 - 1] + samples[n / 2]);
}

Interval slope_of(const std::vector<double>& x, const std::vector<double>& y, double confidence) {
  const double mx = mean(x), my = mean(y), n = static_cast<double>(x.size());
  double xx = 0, xy = 0, left = 0;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  const double b = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i) left += std::pow(y[i] - my - b * (x[i] - mx), 2);
  return student(b, n > 2 ? std::sqrt(left / (n - 2) / xx) : 0, n - 2, confidence);
}

Interval nees_band(int runs, int degrees_of_freedom, double confidence) {
  const double n = static_cast<double>(runs) * degrees_of_freedom;
  const chi_squared spread(n);
  return {1, quantile(spread, (1 - confidence) / 2) / n, quantile(spread, (1 + confidence) / 2) / n};
}

double exponent_of(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) log_x.push_back(std::log(x[i])), log_y.push_back(std::log(y[i]));
  return slope_of(log_x, log_y).value;
}

PairedComparison compare_pairs(const std::vector<double>& samples, const std::vector<double>& reference) {
  if (samples.size() != reference.size())
    throw std::invalid_argument("compare_pairs: " + std::to_string(samples.size()) + " samples, " +
                                std::to_string(reference.size()) + " references");
  std::vector<double> differences;
  std::size_t lower = 0, higher = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::isnan(samples[i]) || std::isnan(reference[i])) continue;
    differences.push_back(samples[i] - reference[i]);
    lower += samples[i] < reference[i];
    higher += samples[i] > reference[i];
  }
  if (differences.empty()) return {0, {unknown, -inf, inf}, unknown, unknown};
  const double n = static_cast<double>(differences.size());
  return {differences.size(), bootstrap_mean(differences), static_cast<double>(lower) / n,
          static_cast<double>(higher) / n};
}

}  // namespace incognita
