#include "incognita/app/loop/snapshot_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace incognita {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr std::array estimator_stages{"sums",      "start",     "predict", "search",     "planes",
                                      "consensus", "associate", "update",  "initialize", "decorrelate",
                                      "poses",     "map",       "entropy"};

StageTimes timing_of(const StageTimes& in_estimator, const StageTimes& loop_ms) {
  StageTimes timing;
  double frame = 0;
  for (const auto& [stage, ms] : loop_ms) {
    const std::string_view name = stage;
    if (name != "estimator") timing.emplace_back(stage, ms);
    if (name == "estimator" || name == "decision" || name == "control") frame += ms;
  }
  for (const char* stage : estimator_stages) {
    const auto found = std::find_if(in_estimator.begin(), in_estimator.end(), [&](const auto& entry) {
      return std::string_view(entry.first) == stage;
    });
    timing.emplace_back(stage, found == in_estimator.end() ? 0.0 : found->second);
  }
  timing.emplace_back("frame", frame);
  return timing;
}

void put_estimate(const Body& body, double t, SnapshotBody& out) {
  out.estimate = {t, body.pose.position, body.pose.world_from_body};
  out.covariance = body.pose_covariance;
  if (body.state.size() == FreeCameraMotion::state_size) out.velocity = body.state.tail<6>();
}

void put_truth(const BodyTruth& truth, double t, SnapshotBody& out) {
  if (!truth.pose) return;
  out.truth = StampedPose{t, truth.pose->position, truth.pose->world_from_body};
  out.truth->oriented = truth.orientation_known;
}

SnapshotDecision decision_of(const BodyGoal& goal, const std::vector<std::string>& actions) {
  return {actions, goal.scores, goal.chosen, goal.decided};
}

/// Before the start the bodies of the truth.
std::vector<SnapshotBody> bodies_of(const Estimate& e, const std::optional<Truth>& truth,
                                    const Command& command, double t) {
  std::vector<SnapshotBody> bodies(std::max(e.bodies.size(), truth ? truth->bodies.size() : 0));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!e.started) bodies[i].state = e.status.state;
    if (i < e.bodies.size()) {
      put_estimate(e.bodies[i], t, bodies[i]);
      bodies[i].state = state_of(e, i);
    }
    if (truth && i < truth->bodies.size()) put_truth(truth->bodies[i], t, bodies[i]);
    const BodyCommand& commanded = command_of(command, i);
    bodies[i].reference = commanded.reference;
    bodies[i].input = commanded.input;
    bodies[i].operator_controlled = commanded.operator_controlled;
  }
  return bodies;
}

/// Embeds a point on a line or plane in space; missing coordinates are 0 with zero covariance.
SnapshotLandmark landmark_of(const Landmark& landmark, const LandmarkPosition& at) {
  SnapshotLandmark out{landmark.id, landmark.fixed, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(),
                       landmark.detection_count};
  const Eigen::Index size = at.position.size();
  out.position.head(size) = at.position;
  out.covariance.topLeftCorner(size, size) = at.covariance;
  return out;
}

/// Anchors first.
std::vector<SnapshotLandmark> landmarks_of(const Estimate& e) {
  std::vector<SnapshotLandmark> out;
  for (const bool fixed : {true, false})
    for (const auto& [id, landmark] : e.landmarks)
      if (landmark.fixed == fixed)
        if (const auto at = position_of(landmark, e)) out.push_back(landmark_of(landmark, *at));
  return out;
}

SnapshotKeyframes keyframes_of(const AdjustedKeyframes& adjusted, double t) {
  const auto stamped = [](double at, const RigidPose& pose) {
    return StampedPose{at, pose.position, pose.world_from_body};
  };
  SnapshotKeyframes out{stamped(t, adjusted.before), {}};
  for (const PastPose& past : adjusted.poses) out.poses.push_back(stamped(past.t, past.pose));
  return out;
}

template <class Numbers>
Eigen::Vector2d first_two(const Numbers& z) {
  return {z.size() > 0 ? z[0] : nan, z.size() > 1 ? z[1] : nan};
}

SnapshotMatch match_of(const Match& match, const std::vector<DepthParticle>& particles) {
  SnapshotMatch out;
  out.id = match.id;
  out.anchor = match.anchor;
  out.ray = match.ray;
  out.body = match.body;
  out.sensor = match.sensor;
  out.image = match.image;
  out.of_body = match.of_body;
  out.predicted = first_two(match.predicted);
  if (!match.image || match.measured.size() > 0) out.measured = first_two(match.measured);
  out.innovation_cov.setConstant(nan);
  const Eigen::Index size = std::min<Eigen::Index>(2, match.innovation_cov.rows());
  out.innovation_cov.topLeftCorner(size, size) = match.innovation_cov.topLeftCorner(size, size);
  out.correlation = match.correlation;
  out.outcome = match.outcome;
  for (int i = 0; i < match.particle_count; ++i) {
    const DepthParticle& particle = particles.at(static_cast<std::size_t>(match.first_particle + i));
    out.particles.push_back({particle.pixel, particle.weight});
  }
  return out;
}

}  // namespace

Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const Estimate& e, const Goal& goal, const Strategy& strategy, const Command& command,
                     const StageTimes& loop_ms) {
  Snapshot s;
  s.tick = tick;
  s.image = image_of(body_of(observation, 0));
  s.status = e.status;
  s.bodies = bodies_of(e, truth, command, tick.t);
  s.landmarks = landmarks_of(e);
  for (const Match& match : e.last.matches) s.matches.push_back(match_of(match, e.last.particles));
  s.predicted = e.last.predicted;
  s.matched = e.last.matched;
  if (e.last.update.outcome == UpdateReport::Outcome::updated) {
    s.nis = e.last.update.nis;
    s.nis_dof = e.last.update.rows;
  }
  if (e.last.adjusted) s.keyframes = keyframes_of(*e.last.adjusted, tick.t);
  for (const Body& body : e.bodies)
    if (body.health.readout) s.readout = body.health.readout;
  s.entropy = {e.entropy.vehicle, e.entropy.map, e.entropy.total, e.entropy_t.value_or(std::nan(""))};
  for (std::size_t i = 0; i < std::min(goal.bodies.size(), s.bodies.size()); ++i) {
    s.bodies[i].manual = goal.bodies[i].manual.has_value();
    s.bodies[i].decision = decision_of(goal.bodies[i], strategy.actions(i));
  }
  s.coverage = goal.coverage;
  s.entropy_extended = goal.entropy_extended;
  s.exploration = goal.exploration;
  s.timing_ms = timing_of(e.timing_ms, loop_ms);
  return s;
}

}  // namespace incognita
