#include "incognita/analysis/evaluation/pose_correction.hpp"

#include "incognita/math/quaternion.hpp"

namespace incognita {

PoseCorrection correction(const StampedPose& from, const StampedPose& to) {
  return {to.position - from.position,
          quaternion_log(quaternion_product(to.orientation, quaternion_conjugate(from.orientation)))};
}

StampedPose corrected(StampedPose pose, const PoseCorrection& c) {
  pose.position += c.position;
  pose.orientation = quaternion_product(quaternion_exp(c.rotation), pose.orientation);
  return pose;
}

PoseCorrection between(const PoseCorrection& a, const PoseCorrection& b, double share) {
  return {a.position + share * (b.position - a.position), a.rotation + share * (b.rotation - a.rotation)};
}

}  // namespace incognita
