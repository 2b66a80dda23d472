#include "incognita/record/summary/adjusted_path.hpp"

#include "incognita/math/quaternion.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

/// Of the position (world, m), and rotation vector in body axes.
struct Correction {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
};

Correction correction(const StampedPose& from, const StampedPose& to) {
  return {to.position - from.position,
          quaternion_log(quaternion_product(quaternion_conjugate(from.orientation), to.orientation))};
}

StampedPose corrected(StampedPose pose, const Correction& c) {
  pose.position += c.position;
  pose.orientation = quaternion_product(pose.orientation, quaternion_exp(c.rotation));
  return pose;
}

/// A share of the way from one to the other.
Correction between(const Correction& a, const Correction& b, double share) {
  return {a.position + share * (b.position - a.position), a.rotation + share * (b.rotation - a.rotation)};
}

}  // namespace

void AdjustedPath::add(const Snapshot& s) {
  if (s.bodies.size() != 1) return;
  if (has_pose(s.bodies[0])) filtered_.push_back(s.bodies[0].estimate);
  if (!s.keyframes) return;
  for (const StampedPose& pose : s.keyframes->poses) keyframes_[pose.t].adjusted = pose;
  keyframes_[s.tick.t].before = s.keyframes->before;
}

Trajectory AdjustedPath::trajectory() const {
  Trajectory out;
  if (keyframes_.empty()) return out;
  Correction last;  // of the last keyframe
  auto next = keyframes_.begin();
  double last_t = next->first;
  for (const StampedPose& pose : filtered_) {
    for (; next != keyframes_.end() && next->first <= pose.t; ++next) {
      last_t = next->first;
      if (last_t == pose.t) last = correction(pose, next->second.adjusted);
    }
    const bool is_between = next != keyframes_.end() && next->second.before && last_t < pose.t;
    out.push_back(corrected(pose, is_between
                                      ? between(last, correction(*next->second.before, next->second.adjusted),
                                                (pose.t - last_t) / (next->first - last_t))
                                      : last));
  }
  return out;
}

}  // namespace incognita
