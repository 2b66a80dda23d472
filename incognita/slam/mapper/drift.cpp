#include "incognita/slam/mapper/drift.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "incognita/math/quaternion.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"

namespace incognita {
namespace {

using Moved = Belief::MovedBlock;

constexpr int correction_errors = 7;  // DriftCorrection::cov
constexpr int increments = 10;        // of the drift, independent

Moved moved_camera(const SmallVector& x, BlockId block, const PartialCorrection& by) {
  const Eigen::Matrix3d& R = by.rotation();
  const Eigen::Matrix3d axes = R * rotation_matrix<double>(Eigen::Vector4d(x.segment<4>(3)));
  Moved out{block, x, SmallMatrix::Identity(12, 12), SmallMatrix::Zero(12, correction_errors)};
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

Moved moved_point(const SmallVector& y, BlockId block, const PartialCorrection& by) {
  const Eigen::Vector3d at = by.moved(y);
  return {block, at, by.rotation(), by.of_point(at)};
}

/// Its initial axes turn, so that the direction in them stays.
Moved moved_inverse_depth(const SmallVector& y, Landmark& landmark, const PartialCorrection& by) {
  Eigen::Vector4d& axes = landmark.form.initial_axes;
  axes = by.turned(axes);
  Moved out{landmark.block, y, SmallMatrix::Identity(6, 6), SmallMatrix::Zero(6, correction_errors)};
  out.x_next.head<3>() = by.moved(y.head<3>());
  out.A.topLeftCorner<3, 3>() = by.rotation();
  out.B.topRows<3>() = by.of_point(out.x_next.head<3>());
  out.B.block<3, 3>(3, 3) = by.share() * InverseDepthLandmark{axes}.by_world_turn(out.x_next).bottomRows<3>();
  out.B(5, 6) = -by.share() * y[5];
  return out;
}

Moved moved_landmark(const AnyBelief& belief, Landmark& landmark, const PartialCorrection& by) {
  landmark.first_view = by.moved(landmark.first_view);
  const SmallVector y = belief.mean(landmark.block);
  if (landmark.form.kind == LandmarkParametrization::Kind::inverse_depth)
    return moved_inverse_depth(y, landmark, by);
  return moved_point(y, landmark.block, by);
}

/// The part of increment `k` of the drift that had passed when a share of it had.
double passed(double share, int k) { return std::clamp(share * increments - k, 0.0, 1.0); }

/// Moves the blocks, and adds the uncertainty that they share: by each increment of the drift, of those it moved.
void move(AnyBelief& belief, std::vector<Moved> moved, const std::vector<double>& shares,
          const DriftCorrection& correction) {
  const SmallVector none = SmallVector::Zero(correction_errors);
  const SmallMatrix same = SmallMatrix::Identity(correction_errors, correction_errors);
  for (int k = 0; k < increments; ++k) {
    std::vector<Moved> by_increment;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const double part = shares[i] > 0 ? passed(shares[i], k) / shares[i] : 0;
      if (k > 0 && part == 0) continue;
      by_increment.push_back(moved[i]);
      by_increment.back().B *= part;
      moved[i].A.setIdentity();
    }
    // A block of its own for a moment, which the errors of all the others depend on
    const BlockId increment =
        belief.augment(Chart::line(correction_errors), none, {}, correction.cov / increments);
    belief.change_frame({increment, none, same, SmallMatrix::Zero(correction_errors, correction_errors)},
                        by_increment);
    belief.drop(increment);
  }
}

}  // namespace

PartialCorrection::PartialCorrection(const DriftCorrection& correction, double share)
    : R_(rotation_exp<double>(Eigen::Vector3d(share * correction.turn))),
      center_(correction.center),
      center_next_(correction.center + share * correction.translation),
      share_(share) {}

Eigen::Vector4d PartialCorrection::turned(const Eigen::Vector4d& world_from_axes) const {
  return quaternion_from_matrix(R_ * rotation_matrix<double>(world_from_axes));
}

Eigen::Matrix<double, 3, 7> PartialCorrection::of_point(const Eigen::Vector3d& at) const {
  Eigen::Matrix<double, 3, 7> J;
  J << share_ * Eigen::Matrix3d::Identity(), of_vector(at - center_next_);
  return J;
}

Eigen::Matrix<double, 3, 4> PartialCorrection::of_vector(const Eigen::Vector3d& v) const {
  Eigen::Matrix<double, 3, 4> J;
  J << -share_ * skew<double>(v), share_ * v;
  return J;
}

void correct_drift(Estimate& e, std::size_t body, const DriftCorrection& correction,
                   const std::vector<DriftingLandmark>& landmarks) {
  const BlockId camera = e.bodies[body].block;
  const SmallVector x = e.belief.mean(camera);
  std::vector<Moved> moved{moved_camera(x, camera, PartialCorrection(correction, 1))};
  std::vector<double> shares{1};
  for (const auto& [id, share] : landmarks) {
    moved.push_back(moved_landmark(e.belief, e.landmarks.at(id), PartialCorrection(correction, share)));
    shares.push_back(share);
  }
  move(e.belief, std::move(moved), shares, correction);
  restart_invariant_errors(e);
}

}  // namespace incognita
