// A run of a scenario that explores, as the experiments of Chapter 6 evaluate it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/outcome_summary.hpp"

namespace incognita {

struct Assembly;

namespace exploring {

/// What a variant sets beside the scenario, e.g. "decision.gaze=fisher".
using Sets = std::vector<std::string>;

struct Instant {
  double t_s = 0;
  StampedPose truth, estimate;
  PoseCovariance covariance;
  SnapshotEntropy entropy;
  int landmarks = 0;  ///< mapped, without anchors
  int matched = 0;    ///< landmarks and anchors measured in this frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(NAN);  ///< estimated, m/s, world; if it is a state
};

struct Decision {
  double t_s = 0;
  int chosen = 0;  ///< of Run::actions
  std::string action;
  std::vector<double> scores;
  double entropy_extended = 0;            ///< of camera, map and what is not mapped yet, nats
  double entropy_camera = 0;              ///< nats
  std::vector<std::int64_t> mapped = {};  ///< ids of the map
  int returned = 0;                       ///< landmarks that came back since the decision before
  double longest_away_s = 0;              ///< of those: how long it had not been matched
};

struct Run {
  std::vector<Instant> instants;
  std::vector<Decision> decisions;
  std::vector<std::string> actions;   ///< names
  std::vector<SnapshotLandmark> map;  ///< at the end, anchors too
  std::vector<double> located_t_s;    ///< of landmarks in the order in which they were located (record/)
  OutcomeMeasures outcome;
  std::int64_t matches_right = 0,
               matches_wrong = 0;  ///< without those of anchors; 0 where identities are given
  double position_rms_m = 0, nees = 0, coverage = 0;
  double entropy_extended = 0;  ///< nats, at the last decision
  double end_s = 0;             ///< of the run, whether lost or not

  /// When so many landmarks were located, and the entropy of camera and map then; none when there were never
  /// so many.
  std::optional<double> located_at_s(int count) const;
  std::optional<double> entropy_when_located(int count) const;
  /// Of those and what is not mapped, at the first decision from then on.
  std::optional<double> extended_when_located(int count) const;
};

/// Landmarks that were not matched for so long have been away; matching them again closes a loop.
inline constexpr double away_s = 5;

/// `scenario`: the name of a built-in one, of one camera in a point-landmark world or in the rendered room.
/// `change`: of its parts before it starts, e.g. of the sensor.
Run explore(const std::string& scenario, const Sets& sets, std::uint64_t seed,
            const std::function<void(Assembly&)>& change = {});

}  // namespace exploring
}  // namespace incognita
