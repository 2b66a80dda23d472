#include "incognita/slam/mapper/drift.hpp"

#include <cmath>

#include "incognita/math/quaternion.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"

namespace incognita {
namespace {

using Moved = Belief::MovedBlock;

/// Errors of the transform: its translation and turn, world axes, and the logarithm of its scale.
constexpr int drift_errors = 7;

/// A share of the transform, and the derivatives of what it moved by its errors.
class Transform {
 public:
  Transform(const Drift& drift, const Eigen::Vector3d& center, double share)
      : R_(rotation_exp<double>(Eigen::Vector3d(share * drift.turn))),
        center_(center),
        center_next_(center + share * drift.translation),
        share_(share) {}

  const Eigen::Matrix3d& rotation() const { return R_; }
  Eigen::Vector3d moved(const Eigen::Vector3d& point) const { return center_next_ + R_ * (point - center_); }
  /// Of a point that was moved to `at`: 3 x 7.
  Eigen::Matrix<double, 3, drift_errors> of_point(const Eigen::Vector3d& at) const {
    Eigen::Matrix<double, 3, drift_errors> J;
    J << share_ * Eigen::Matrix3d::Identity(), of_vector(at - center_next_);
    return J;
  }
  /// Of a vector from the center, by turn and scale: 3 x 4.
  Eigen::Matrix<double, 3, 4> of_vector(const Eigen::Vector3d& v) const {
    Eigen::Matrix<double, 3, 4> J;
    J << -share_ * skew<double>(v), share_ * v;
    return J;
  }

 private:
  Eigen::Matrix3d R_;
  Eigen::Vector3d center_, center_next_;
  double share_;
};

Moved moved_camera(const SmallVector& x, BlockId block, const Transform& by) {
  const Eigen::Matrix3d& R = by.rotation();
  const Eigen::Matrix3d axes = R * rotation_matrix<double>(Eigen::Vector4d(x.segment<4>(3)));
  Moved out{block, x, SmallMatrix::Identity(12, 12), SmallMatrix::Zero(12, drift_errors)};
  out.x_next.head<3>() = by.moved(x.head<3>());
  out.x_next.segment<4>(3) = quaternion_from_matrix(axes);
  out.x_next.segment<3>(7) = R * x.segment<3>(7);
  out.A.topLeftCorner<3, 3>() = out.A.block<3, 3>(6, 6) =
      R;  // rotation errors and rates are in the axes of the body
  out.B.topRows<3>() = by.of_point(out.x_next.head<3>());
  out.B.block<3, 3>(3, 3) = axes.transpose();
  out.B.block<3, 4>(6, 3) = by.of_vector(out.x_next.segment<3>(7));
  return out;
}

Moved moved_point(const SmallVector& y, BlockId block, const Transform& by) {
  const Eigen::Vector3d at = by.moved(y);
  return {block, at, by.rotation(), by.of_point(at)};
}

/// Its initial axes turn, so that the direction in them stays.
Moved moved_inverse_depth(const SmallVector& y, Landmark& landmark, const Transform& by, double share) {
  Eigen::Vector4d& axes = landmark.form.initial_axes;
  axes = quaternion_from_matrix(by.rotation() * rotation_matrix<double>(axes));
  Moved out{landmark.block, y, SmallMatrix::Identity(6, 6), SmallMatrix::Zero(6, drift_errors)};
  out.x_next.head<3>() = by.moved(y.head<3>());
  out.A.topLeftCorner<3, 3>() = by.rotation();
  out.B.topRows<3>() = by.of_point(out.x_next.head<3>());
  out.B.block<3, 3>(3, 3) = share * InverseDepthLandmark{axes}.by_world_turn(out.x_next).bottomRows<3>();
  out.B(5, 6) = -share * y[5];
  return out;
}

Moved moved_landmark(const AnyBelief& belief, Landmark& landmark, const Transform& by, double share) {
  landmark.first_view = by.moved(landmark.first_view);
  const SmallVector y = belief.mean(landmark.block);
  if (landmark.form.kind == LandmarkParametrization::Kind::inverse_depth)
    return moved_inverse_depth(y, landmark, by, share);
  return moved_point(y, landmark.block, by);
}

}  // namespace

void undo_drift(Estimate& e, std::size_t body, const Drift& drift,
                const std::vector<DriftingLandmark>& landmarks) {
  const BlockId camera = e.bodies[body].block;
  const SmallVector x = e.belief.mean(camera);
  const Eigen::Vector3d center = x.head<3>();
  std::vector<Moved> moved{moved_camera(x, camera, Transform(drift, center, 1))};
  for (const auto& [id, share] : landmarks)
    moved.push_back(moved_landmark(e.belief, e.landmarks.at(id), Transform(drift, center, share), share));
  const SmallVector none = SmallVector::Zero(drift_errors);
  // A block of its own for a moment, which the errors of all the others depend on
  const BlockId transform = e.belief.augment(Chart::line(drift_errors), none, {}, drift.cov);
  e.belief.change_frame({transform, none, SmallMatrix::Identity(drift_errors, drift_errors),
                         SmallMatrix::Zero(drift_errors, drift_errors)},
                        moved);
  e.belief.drop(transform);
  restart_invariant_errors(e);
}

}  // namespace incognita
