// Numbers of runs compared: two ways on the same seeds, pair by pair, and the least and the most of many.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace incognita {

/// a - b of each pair, where both are numbers.
inline std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (std::isfinite(a[i] - b[i])) difference.push_back(a[i] - b[i]);
  return difference;
}

/// log(a / b) of each pair.
inline std::vector<double> log_ratios(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) logarithms.push_back(std::log(a[i] / b[i]));
  return logarithms;
}

struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void take(double number) { least = std::min(least, number), most = std::max(most, number); }
};

/// Of what each step leaves of a distance, over the steps from `from` to `to`.
inline Extremes left_by_steps(const std::vector<double>& distances, std::size_t from, std::size_t to) {
  Extremes ratios;
  for (std::size_t k = from; k < to; ++k) ratios.take(distances[k + 1] / distances[k]);
  return ratios;
}

}  // namespace incognita
