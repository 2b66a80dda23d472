#include "incognita/record/summary/path_summary.hpp"

#include "incognita/record/snapshot/series.hpp"

namespace incognita {

void PathSummary::add(const Snapshot& s) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    add(i, s.bodies[i].truth, has_pose(s.bodies[i]) ? std::optional(s.bodies[i].estimate) : std::nullopt);
}

void PathSummary::add(std::size_t body, const std::optional<StampedPose>& truth,
                      const std::optional<StampedPose>& estimate) {
  if (bodies_.size() <= body) {
    bodies_.resize(body + 1);
    last_truth_.resize(body + 1);
    last_estimate_.resize(body + 1);
  }
  BodyPath& path = bodies_[body];
  if (truth) {
    const auto& last = last_truth_[body];
    path.true_length_m =
        path.true_length_m.value_or(0) + (last ? (truth->position - last->position).norm() : 0);
    last_truth_[body] = truth;
  }
  if (estimate) {
    const auto& last = last_estimate_[body];
    if (last) path.estimated_length += (estimate->position - last->position).norm();
    last_estimate_[body] = estimate;
  }
  if (truth && estimate) path.truth = truth, path.estimate = estimate;
  path.truth_has_gaps |= estimate && !truth;
}

}  // namespace incognita
