#include "incognita/record/summary/exploration_summary.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace incognita {

void ExplorationSummary::add(const Snapshot& s) {
  if (s.coverage) coverage_ = s.coverage;
  if (s.entropy_extended) entropy_extended_ = s.entropy_extended;
  if (s.bodies.empty()) return;
  const Eigen::Vector3d& from = s.bodies.front().estimate.position;
  for (const SnapshotLandmark& l : s.landmarks) {
    if (l.anchor || located_t_s_.count(l.id) > 0) continue;
    const double away_m = (l.position - from).norm();
    const double limit = located_ratio * away_m;
    // The trace bounds the largest eigenvalue from both sides and is far cheaper.
    const double trace = l.covariance.trace();
    if (!(trace < 3 * limit * limit)) continue;
    const double largest = l.covariance.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
    if (largest < limit * limit) located_t_s_.emplace(l.id, s.tick.t);
  }
}

std::optional<double> ExplorationSummary::located_t_s(int count) const {
  if (count < 1 || count > located()) return std::nullopt;
  std::vector<double> times;
  for (const auto& [id, t] : located_t_s_) times.push_back(t);
  std::nth_element(times.begin(), times.begin() + count - 1, times.end());
  return times[static_cast<std::size_t>(count - 1)];
}

}  // namespace incognita
