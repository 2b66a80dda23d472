#include "incognita/decision/expectation.hpp"

#include <algorithm>
#include <numeric>

namespace incognita {

void keep_most_uncertain(std::vector<ExpectedLook>& looks, std::vector<double>& traces, std::size_t count,
                         int most) {
  if (count <= static_cast<std::size_t>(most)) return;
  std::vector<double> sorted(traces.begin(), traces.begin() + static_cast<std::ptrdiff_t>(count));
  std::nth_element(sorted.begin(), sorted.begin() + most, sorted.end(), std::greater<>());
  const double least = sorted[static_cast<std::size_t>(most)];
  std::size_t kept = 0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const bool taken = i >= count || (traces[i] > least && kept < static_cast<std::size_t>(most));
    if (!taken) continue;
    if (kept != i) looks[kept] = looks[i];
    ++kept;
  }
  looks.resize(kept);
}

}  // namespace incognita
