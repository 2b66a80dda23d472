#include "incognita/decision/expectation.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace incognita {

void MapExpectation::prepare(const Estimate& estimate, std::size_t body,
                             const std::vector<ExpectedLandmark>& unseen, double unseen_var_m2) {
  body_ = body;
  for (const auto& sensor : bodies_.at(body)) sensor->prepare(estimate, unseen, unseen_var_m2);
}

void MapExpectation::expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const {
  measurements.clear();
  for (const auto& sensor : bodies_[body_]) sensor->add(state, measurements);
}

bool MapExpectation::in_view(std::size_t body, const BlockVector& state,
                             const Eigen::Vector3d& position) const {
  return std::ranges::any_of(bodies_.at(body),
                             [&](const auto& sensor) { return sensor->in_view(state, position); });
}

double least_of_the_best(const std::vector<double>& traces, int most, std::vector<double>& sorted) {
  if (traces.size() <= static_cast<std::size_t>(most)) return -std::numeric_limits<double>::infinity();
  sorted = traces;
  const auto last = sorted.begin() + most - 1;
  std::nth_element(sorted.begin(), last, sorted.end(), std::greater<>());
  return *last;
}

}  // namespace incognita
