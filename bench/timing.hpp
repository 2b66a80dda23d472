// Timers for benchmarks that interleave the variants, so that load changes of the machine affect all alike.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

/// Wall-clock time, s.
template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time, s: excludes other programs.
template <class Work>
double processor_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The median; the upper one for an even number of values.
inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}
