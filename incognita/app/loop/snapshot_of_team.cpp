#include <array>
#include <cmath>
#include <limits>

#include "incognita/app/loop/snapshot_of.hpp"
#include "incognita/app/loop/snapshot_parts.hpp"

namespace incognita {
namespace {

constexpr std::array team_stages{"predict",     "associate", "update", "births",
                                 "decorrelate", "poses",     "entropy"};

SnapshotVehicle in_space(const TeamEstimate& e, std::size_t i, const std::optional<Truth>& truth,
                         const Command& command, double t) {
  const TeamVehicle& vehicle = e.vehicles[i];
  SnapshotVehicle out;
  out.estimate = {t, vehicle.pose.position, vehicle.pose.world_from_body};
  out.covariance = vehicle.pose_covariance;
  if (truth && i < truth->poses.size() && truth->poses[i])
    out.truth = StampedPose{t, truth->poses[i]->position, truth->poses[i]->world_from_body};
  if (i < command.references.size()) out.reference = command.references[i];
  if (i < command.inputs.size()) out.input = command.inputs[i];
  return out;
}

/// Embeds a point on a line or plane in space; missing coordinates are 0 with zero covariance.
SnapshotLandmark in_space(std::int64_t id, const TeamPosition& at, int detection_count) {
  SnapshotLandmark out{id, false, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), detection_count};
  const Eigen::Index size = at.position.size();
  out.position.head(size) = at.position;
  out.covariance.topLeftCorner(size, size) = at.covariance;
  return out;
}

SnapshotLandmark known(std::int64_t id, const TeamAnchor& anchor) {
  SnapshotLandmark out{id, true, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), anchor.detection_count};
  out.position.head(anchor.position.size()) = anchor.position;
  return out;
}

double number(const SmallVector& numbers, Eigen::Index i) {
  return i < numbers.size() ? numbers[i] : std::numeric_limits<double>::quiet_NaN();
}

SnapshotMatch match_of(const Match& match) {
  SnapshotMatch out;
  out.id = match.identity;
  out.anchor = match.anchor;
  out.vehicle = match.vehicle;
  out.of_vehicle = match.of_vehicle;
  out.predicted = {number(match.predicted, 0), number(match.predicted, 1)};
  out.measured = Eigen::Vector2d(number(match.measured, 0), number(match.measured, 1));
  out.innovation_cov.setConstant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Index size = std::min<Eigen::Index>(2, match.innovation_cov.rows());
  out.innovation_cov.topLeftCorner(size, size) = match.innovation_cov.topLeftCorner(size, size);
  out.outcome = match.outcome;
  return out;
}

}  // namespace

Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation&,
                     const TeamEstimate& e, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms) {
  Snapshot s;
  s.tick = tick;
  if (truth && (truth->poses.empty() || truth->poses.front())) s.truth = truth;
  s.status = e.status;
  for (std::size_t i = 0; i < e.vehicles.size(); ++i)
    s.vehicles.push_back(in_space(e, i, truth, command, tick.t));
  if (e.started) {
    s.camera.head<3>() = s.vehicles.front().estimate.position;
    s.camera.segment<4>(3) = s.vehicles.front().estimate.orientation;
    s.covariance.topLeftCorner<6, 6>() = s.vehicles.front().covariance;
  }
  for (const auto& [identity, anchor] : e.anchors) s.landmarks.push_back(known(identity, anchor));
  for (const auto& [identity, landmark] : e.landmarks)
    if (const auto at = position_of(landmark, e))
      s.landmarks.push_back(in_space(identity, *at, landmark.detection_count));
  for (const Match& match : e.matches) s.matches.push_back(match_of(match));
  s.predicted = static_cast<int>(e.matches.size());
  s.matched = e.matched;
  put_update(s, e.update, e.entropy);
  s.decision = snapshot_decision(goal, actions);
  s.command = command;
  s.timing_ms = timing_of(e.timing_ms, team_stages, loop_ms);
  return s;
}

}  // namespace incognita
