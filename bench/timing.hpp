// Times taken in turns inside one benchmark, so that the machine's swings hit all alike.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

/// Of the clock on the wall, s.
template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The upper one of an even number.
inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}
