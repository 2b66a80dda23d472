#include "incognita/decision/expectation.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace incognita {

double least_of_the_best(const std::vector<double>& traces, int most, std::vector<double>& sorted) {
  if (traces.size() <= static_cast<std::size_t>(most)) return -std::numeric_limits<double>::infinity();
  sorted = traces;
  const auto last = sorted.begin() + most - 1;
  std::nth_element(sorted.begin(), last, sorted.end(), std::greater<>());
  return *last;
}

}  // namespace incognita
