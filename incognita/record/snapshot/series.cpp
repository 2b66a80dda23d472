#include "incognita/record/snapshot/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/math/largest_sigma.hpp"

namespace incognita {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

StampedPose pose(double t, const FreeCameraMotion::State<double>& camera) {
  return {t, free_camera::position(camera), free_camera::orientation(camera)};
}

void append_pose_columns(std::vector<std::string>& columns, const std::string& prefix) {
  for (const char* axis : {"x", "y", "z"}) columns.push_back(prefix + axis + "_m");
  for (const char* axis : {"rotx", "roty", "rotz"}) columns.push_back(prefix + axis + "_rad");
}

void append(std::vector<double>& row, const Eigen::VectorXd& values) {
  row.insert(row.end(), values.begin(), values.end());
}

/// Errors of the six pose components (estimate minus truth; m, rad), and NEES.
Eigen::VectorXd errors(const Snapshot& snapshot, const PoseCovariance& P) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(7, unknown);
  if (!snapshot.truth || !has_pose(snapshot)) return values;
  // pose_error() is truth minus estimate; NEES does not depend on the sign.
  values.head<6>() = -pose_error(true_pose(snapshot.tick, *snapshot.truth), estimated_pose(snapshot));
  values[6] = pose_nees(values.head<6>(), P).value_or(unknown);
  return values;
}

}  // namespace

bool has_pose(const Snapshot& snapshot) {
  return snapshot.status.state != TrackingState::starting && snapshot.status.state != TrackingState::lost;
}

StampedPose estimated_pose(const Snapshot& snapshot) { return pose(snapshot.tick.t, snapshot.camera); }

StampedPose true_pose(const Tick& tick, const Truth& truth) {
  StampedPose out = pose(tick.t, truth.camera);
  out.oriented = truth.orientation_known;
  return out;
}

PoseCovariance pose_covariance(const Snapshot& snapshot) { return snapshot.covariance.topLeftCorner<6, 6>(); }

int mapped_landmarks(const Snapshot& snapshot) {
  return static_cast<int>(std::count_if(snapshot.landmarks.begin(), snapshot.landmarks.end(),
                                        [](const SnapshotLandmark& landmark) { return !landmark.anchor; }));
}

std::vector<std::string> series_columns(bool with_errors) {
  std::vector<std::string> columns{"matched",          "predicted",          "landmarks",
                                   "sigma_position_m", "sigma_rotation_rad", "entropy_vehicle_nats",
                                   "entropy_map_nats", "entropy_total_nats", "nis",
                                   "nis_dof",          "coverage",           "entropy_extended_nats"};
  append_pose_columns(columns, "two_sigma_");
  if (with_errors) {
    append_pose_columns(columns, "error_");
    columns.push_back("nees_per_dof");
  }
  for (const char* axis : {"x", "y", "z"}) columns.push_back(std::string("command_a") + axis + "_m_s2");
  for (const char* axis : {"x", "y", "z"}) columns.push_back(std::string("command_alpha") + axis + "_rad_s2");
  return columns;
}

std::vector<double> series_row(const Snapshot& snapshot, bool with_errors) {
  const bool posed = has_pose(snapshot);
  const PoseCovariance P = pose_covariance(snapshot);
  std::vector<double> row{static_cast<double>(snapshot.matched),
                          static_cast<double>(snapshot.predicted),
                          static_cast<double>(mapped_landmarks(snapshot)),
                          posed ? largest_sigma(P.topLeftCorner<3, 3>()) : unknown,
                          posed ? largest_sigma(P.bottomRightCorner<3, 3>()) : unknown,
                          snapshot.entropy.vehicle,
                          snapshot.entropy.map,
                          snapshot.entropy.total,
                          snapshot.nis_dof > 0 ? snapshot.nis : unknown,
                          static_cast<double>(snapshot.nis_dof),
                          snapshot.decision.coverage.value_or(unknown),
                          snapshot.decision.entropy_extended.value_or(unknown)};
  append(row, posed ? Eigen::VectorXd(2 * P.diagonal().cwiseMax(0).cwiseSqrt())
                    : Eigen::VectorXd::Constant(6, unknown));
  if (with_errors) append(row, errors(snapshot, P));
  append(row, snapshot.command.as_input());
  return row;
}

}  // namespace incognita
