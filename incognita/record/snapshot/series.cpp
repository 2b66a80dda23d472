#include "incognita/record/snapshot/series.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/math/largest_sigma.hpp"
#include "incognita/math/unknown.hpp"

namespace incognita {
namespace {

void append_pose_columns(std::vector<std::string>& columns, const std::string& prefix) {
  for (const char* axis : {"x", "y", "z"}) columns.push_back(prefix + axis + "_m");
  for (const char* axis : {"rotx", "roty", "rotz"}) columns.push_back(prefix + axis + "_rad");
}

void append(std::vector<double>& row, const Eigen::VectorXd& values) {
  row.insert(row.end(), values.begin(), values.end());
}

/// Errors of the six pose components (estimate minus truth; m, rad), and NEES. `body`: null without a valid pose.
Eigen::VectorXd errors(const SnapshotBody* body) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(7, unknown);
  if (!body || !body->truth) return values;
  // pose_error() is truth minus estimate; NEES does not depend on the sign.
  values.head<6>() = -pose_error(*body->truth, body->estimate);
  values[6] = pose_nees(values.head<6>(), body->covariance).value_or(unknown);
  return values;
}

}  // namespace

bool has_pose(const SnapshotBody& body) {
  return body.state != TrackingState::starting && body.state != TrackingState::lost;
}

int mapped_landmarks(const Snapshot& snapshot) {
  return static_cast<int>(std::count_if(snapshot.landmarks.begin(), snapshot.landmarks.end(),
                                        [](const SnapshotLandmark& landmark) { return !landmark.anchor; }));
}

std::vector<std::string> series_columns(bool with_errors) {
  std::vector<std::string> columns{"matched",
                                   "predicted",
                                   "landmarks",
                                   "sigma_position_m",
                                   "sigma_rotation_rad",
                                   "entropy_vehicle_nats",
                                   "entropy_map_nats",
                                   "entropy_total_nats",
                                   "entropy_t_s",
                                   "nis",
                                   "nis_dof",
                                   "coverage",
                                   "entropy_extended_nats",
                                   "mapped"};
  append_pose_columns(columns, "two_sigma_");
  if (with_errors) {
    append_pose_columns(columns, "error_");
    columns.push_back("nees_per_dof");
  }
  return columns;
}

std::vector<double> series_row(const Snapshot& snapshot, bool with_errors) {
  const bool has_first = !snapshot.bodies.empty() && has_pose(snapshot.bodies.front());
  const SnapshotBody* posed = has_first ? &snapshot.bodies.front() : nullptr;
  const PoseCovariance P = posed ? posed->covariance : PoseCovariance::Zero();
  std::vector<double> row{static_cast<double>(snapshot.matched),
                          static_cast<double>(snapshot.predicted),
                          static_cast<double>(mapped_landmarks(snapshot)),
                          posed ? largest_sigma(P.topLeftCorner<3, 3>()) : unknown,
                          posed ? largest_sigma(P.bottomRightCorner<3, 3>()) : unknown,
                          snapshot.entropy.vehicle,
                          snapshot.entropy.map,
                          snapshot.entropy.total,
                          snapshot.entropy.t,
                          snapshot.nis_dof > 0 ? snapshot.nis : unknown,
                          static_cast<double>(snapshot.nis_dof),
                          snapshot.coverage.value_or(unknown),
                          snapshot.entropy_extended.value_or(unknown),
                          snapshot.mapped.value_or(unknown)};
  append(row, posed ? Eigen::VectorXd(2 * P.diagonal().cwiseMax(0).cwiseSqrt())
                    : Eigen::VectorXd::Constant(6, unknown));
  if (with_errors) append(row, errors(posed));
  return row;
}

}  // namespace incognita
