#include "incognita/record/summary/adjusted_path.hpp"

#include "incognita/analysis/evaluation/pose_correction.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
void AdjustedPath::add(const Snapshot& s) {
  if (s.bodies.size() != 1) return;
  if (has_pose(s.bodies[0])) {
    const StampedPose& pose = s.bodies[0].estimate;
    const Eigen::Vector3d& reached = s.keyframes ? s.keyframes->before.position : pose.position;
    const double traveled_m =
        filtered_.empty() ? 0
                          : filtered_.back().traveled_m + (reached - filtered_.back().pose.position).norm();
    filtered_.push_back({pose, traveled_m});
    if (s.keyframes) keyframes_[s.tick.t].before = Filtered{s.keyframes->before, traveled_m};
  }
  if (!s.keyframes) return;
  for (const StampedPose& pose : s.keyframes->poses) keyframes_[pose.t].adjusted = pose;
}

Trajectory AdjustedPath::trajectory() const {
  Trajectory out;
  if (keyframes_.empty()) return out;
  auto next = keyframes_.begin();
  double last_t = next->first, last_traveled_m = 0;  // of the last keyframe
  PoseCorrection last;
  for (const Filtered& frame : filtered_) {
    for (; next != keyframes_.end() && next->first <= frame.pose.t; ++next) {
      last_t = next->first;
      last_traveled_m = frame.traveled_m;
      if (last_t == frame.pose.t) last = correction(frame.pose, next->second.adjusted);
    }
    PoseCorrection now = last;
    if (next != keyframes_.end() && next->second.before && last_t < frame.pose.t) {
      const Filtered& before = *next->second.before;
      const double distance_m = before.traveled_m - last_traveled_m;
      if (distance_m > 0)
        now = between(last, correction(before.pose, next->second.adjusted),
                      (frame.traveled_m - last_traveled_m) / distance_m);
    }
    out.push_back(corrected(frame.pose, now));
  }
  return out;
}

}  // namespace incognita
