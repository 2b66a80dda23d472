#include "incognita/record/summary/outcome_summary.hpp"

#include <cmath>

#include "incognita/analysis/evaluation/mapped_share.hpp"
#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {

void OutcomeSummary::add(const Snapshot& s) {
  lost_ = s.status.state == TrackingState::lost;
  if (!same_frame_) return;
  map_ = s.landmarks;
  add_poses(s);
  add_mapped(s);
}

void OutcomeSummary::add_poses(const Snapshot& s) {
  for (const SnapshotBody& body : s.bodies) {
    knows_truth_ |= body.truth.has_value();
    if (!body.truth || !has_pose(body)) continue;
    squares_m2_ += (body.truth->position - body.estimate.position).squaredNorm();
    ++poses_;
  }
}

void OutcomeSummary::add_mapped(const Snapshot& s) {
  constexpr double early_s = 60, most = 0.9;
  if (!s.mapped) return;
  mapped_ = s.mapped;
  // The last frame of a run of 60 s is one period before. A resumed run may begin after either event
  const bool early = !has_come(early_s, s.tick.t + s.tick.dt), few = *s.mapped < most;
  if (!early && was_early_ && !mapped_60_s_) mapped_60_s_ = s.mapped;
  if (!few && had_few_ && !t_90_mapped_s_) t_90_mapped_s_ = s.tick.t;
  was_early_ |= early;
  had_few_ |= few;
}

void OutcomeSummary::put_map(OutcomeMeasures& m) const {
  double squares_m2 = 0, near = 0, covered = 0;
  for (const SnapshotLandmark& landmark : map_) {
    if (landmark.anchor || !landmark.truth) continue;
    const Eigen::Vector3d error = *landmark.truth - landmark.position;
    ++m.landmarks;
    squares_m2 += error.squaredNorm();
    near += error.norm() <= mapped_within_m;
    covered += !beyond_three_sigma(error, landmark.covariance);
  }
  if (m.landmarks == 0) return;
  m.map_rms_m = std::sqrt(squares_m2 / m.landmarks);
  m.within_5_cm = near / m.landmarks;
  m.within_3_sigma = covered / m.landmarks;
}

OutcomeMeasures OutcomeSummary::measures() const {
  OutcomeMeasures m;
  m.mapped = mapped_;
  m.mapped_60_s = mapped_60_s_;
  m.t_90_mapped_s = t_90_mapped_s_;
  put_map(m);
  if (poses_ > 0) m.position_rms_m = std::sqrt(squares_m2_ / static_cast<double>(poses_));
  m.lost = lost_;
  if (knows_truth_) m.diverged = lost_ || !m.position_rms_m || !(*m.position_rms_m <= diverged_m);
  return m;
}

}  // namespace incognita
