// The joint estimate of one or several vehicles and of the landmarks that they measure, updated in place.
//
// The map is expressed in the world or, for one vehicle on a plane, in the vehicle frame (Castellanos et al.,
// "Robocentric map joining", RAS 2007; the third way of thesis Section 3.2). In the latter case the belief
// consists of the motion of the vehicle since the last tick, the pose of the world relative to the vehicle,
// and landmarks relative to the vehicle; TeamVehicle::pose and position_of() are in the world either way.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/models/any_sensor.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"
#include "incognita/slam/mapper/status.hpp"

namespace incognita {

struct TeamVehicle {
  BlockId block = 0;
  SmallVector prediction;            ///< state after the last prediction, before the corrections of that tick
  double t = 0;                      ///< s, time of the prediction
  std::optional<SmallVector> input;  ///< last odometry reading, held until the next
  double input_t = 0;                ///< s, time of that reading
  std::optional<Eigen::Vector2d> wheels;  ///< speed, m/s, turn rate, rad/s, of a camera's carrier
  double input_period = 0;                ///< s, between the last two readings; 0 before the second

  // After the last tick, in the world
  SmallVector state;             ///< as defined by the motion model
  SmallMatrix state_covariance;  ///< of the state error
  RigidPose pose = {};           ///< as a rigid body in space
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of its error
};

struct TeamLandmark {
  std::int64_t identity = 0;
  LandmarkParametrization form;
  BlockId block = 0;
  SmallVector first;  ///< first estimate, for first-estimate Jacobians
  int detection_count = 0;
};

/// A landmark at a known position, not part of the belief.
struct TeamAnchor {
  SmallVector position;  ///< world, m
  int detection_count = 0;
};

/// A detection with its association.
struct Match {
  int vehicle = 0;
  bool of_vehicle = false;
  bool anchor = false;
  std::int64_t identity = 0;   ///< of the associated landmark; Detection::unknown: none
  SmallVector measured;        ///< in the coordinates of the sensor
  SmallVector predicted;       ///< before the update; empty without a prediction and for new landmarks
  SmallMatrix innovation_cov;  ///< rows x rows; empty in the same cases
  MatchOutcome outcome = MatchOutcome::not_searched;
};

/// A position fix that was applied to a vehicle.
struct UsedFix {
  int vehicle = 0;
  Eigen::Vector2d position{0.0, 0.0};  ///< world, m
  double sigma_m = 0;
};

/// The matches of a tick that passed the gate, and the candidates for new landmarks.
struct Inliers {
  std::vector<std::size_t> indices;     ///< into TeamEstimate::matches
  std::vector<std::size_t> candidates;  ///< of landmarks to initialize, into TeamEstimate::matches
  std::vector<LinearizedMeasurement> measurements;  ///< linearized about the means before the update
  Eigen::MatrixXd S;                                ///< innovation covariance of one match
};

struct TeamEstimate {
  AnyBelief belief;
  bool started = false;
  std::vector<TeamVehicle> vehicles;
  std::optional<BlockId> world;  ///< pose of the world in the vehicle frame; only for a map in that frame
  /// By identity, or by a number of the estimator for detections without identity; without the anchors.
  std::map<std::int64_t, TeamLandmark> landmarks;
  std::int64_t next_number = 0;  ///< next number of the estimator; numbers are unique
  std::map<std::int64_t, TeamAnchor> anchors;
  TrackingStatus status;

  // Results of the last tick
  std::vector<Match> matches;
  std::vector<UsedFix> fixes;
  Inliers inliers;  ///< workspace of the estimator, kept to avoid allocation
  int matched = 0;
  UpdateReport update;
  bool refused = false;                        ///< an update or a fix was not usable within rounding
  bool association_capped = false;             ///< the joint search reached its node limit
  int iterations = 0;                          ///< of the iterated update
  int doubted_ticks = 0, unmatched_ticks = 0;  ///< consecutive: with large innovations, without a match
  double recent_nis = 0, recent_rows = 0;      ///< weighted sums over updates, forgetting factor 0.9
  Entropy entropy;                             ///< refreshed about once a second: entropy_period_s()
  std::optional<double> entropy_t;             ///< s, time of its last refresh
  std::int64_t unconverged_updates = 0;        ///< iterated updates that reached the iteration limit
  std::int64_t capped_associations = 0;        ///< joint searches that reached the node limit
  std::vector<std::pair<const char*, double>> timing_ms;
};

/// Position of a landmark in the world, in the dimensions of the map, and its covariance.
struct TeamPosition {
  SmallVector position;
  SmallMatrix covariance;
};
/// Nothing unless the inverse depth is positive: the landmark may be at infinity.
std::optional<TeamPosition> position_of(const TeamLandmark& landmark, const TeamEstimate& estimate);

/// Entropies of the vehicles, the map and both: thesis (6.2). Cubic in the map, linear with a block-diagonal map.
Entropy entropies(const TeamEstimate& estimate);

}  // namespace incognita
