#include "incognita/slam/mapper/invariant_errors.hpp"

#include <vector>

#include "incognita/math/quaternion.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {
namespace {

constexpr int rotation = 3;  // index of its first error in those of a free camera

ByTurn by_world_turn(const Landmark& landmark, const AnyBelief& belief) {
  if (landmark.form.kind == LandmarkParametrization::Kind::inverse_depth)
    return InverseDepthLandmark{landmark.form.initial_axes}.by_world_turn(belief.mean(landmark.block));
  return PointLandmark::by_world_turn(belief.mean(landmark.block));
}

Eigen::Matrix3d axes_of(const SmallVector& camera) {
  return rotation_matrix<double>(Eigen::Vector4d(camera.segment<4>(3)));
}

/// `R`: axes of the body, world_from_body, that its rotation error is in.
void shear_landmarks(Estimate& e, BlockId body, const Eigen::Matrix3d& R) {
  std::vector<ErrorShear> shears;
  for (auto& [id, landmark] : e.landmarks) {
    if (!landmark.mapped() || landmark.by_turn.rows() == 0) continue;
    const ByTurn now = by_world_turn(landmark, e.belief);
    shears.push_back({landmark.block, (now - landmark.by_turn) * R});
    landmark.by_turn = now;
  }
  e.belief.shear(body, rotation, shears);
}

void keep_body(AnyBelief& belief, BlockId body, const SmallVector& before) {
  constexpr int errors = FreeCameraMotion::error_size;
  const SmallVector now = belief.mean(body);
  const Eigen::Matrix3d R = axes_of(before);
  const auto moved = [&](int at) -> Eigen::Matrix3d {
    return -skew<double>(Eigen::Vector3d(now.segment<3>(at) - before.segment<3>(at))) * R;
  };
  SmallMatrix A = SmallMatrix::Identity(errors, errors);
  A.block<3, 3>(0, rotation) = moved(0);
  A.block<3, 3>(rotation, rotation) = axes_of(now).transpose() * R;
  A.block<3, 3>(6, rotation) = moved(7);  // velocity
  belief.replace(body, FreeCameraMotion::chart, now, A, SmallMatrix::Zero(errors, errors));
}

}  // namespace

void keep_errors_invariant(Estimate& e, BlockId body, const SmallVector& before) {
  shear_landmarks(e, body, axes_of(before));
  keep_body(e.belief, body, before);
}

void begin_invariant_errors(Estimate& e) {
  for (auto& [id, landmark] : e.landmarks)
    if (landmark.mapped() && landmark.by_turn.rows() == 0)
      landmark.by_turn = by_world_turn(landmark, e.belief);
}

void restart_invariant_errors(Estimate& e) {
  for (auto& [id, landmark] : e.landmarks)
    if (landmark.by_turn.rows() > 0) landmark.by_turn = by_world_turn(landmark, e.belief);
}

}  // namespace incognita
