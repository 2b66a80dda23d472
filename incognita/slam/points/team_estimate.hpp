// The estimate of one or several vehicles and of the landmarks that they measure: one belief. Updated in place.
//
// The map is expressed in the world or, for one vehicle on a plane, in the frame of the vehicle (Castellanos et al.,
// "Robocentric map joining", RAS 2007; the third way of thesis Section 3.2). Then the belief holds the motion of the
// vehicle since the last tick, the pose of the world seen from the vehicle, and landmarks relative to the vehicle;
// TeamVehicle::pose and position_of() are in the world either way.
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
  SmallVector prediction;            ///< state after the last prediction, before any correction of that tick
  double t = 0;                      ///< s, up to which it is predicted
  std::optional<SmallVector> input;  ///< the last odometry reading, held until the next
  double input_t = 0;                ///< s, of that reading
  std::optional<Eigen::Vector2d>
      wheels;               ///< speed, m/s, and turn rate, rad/s, of the vehicle that carries a camera
  double input_period = 0;  ///< s, between the last two readings; 0 before the second

  // After the last tick, in the world
  SmallVector state;             ///< as the motion model has it
  SmallMatrix state_covariance;  ///< of its error
  RigidPose pose = {};           ///< as a body in space
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of its error
};

struct TeamLandmark {
  std::int64_t identity = 0;
  LandmarkParametrization form;
  BlockId block = 0;
  SmallVector first;  ///< first estimate, where first-estimate Jacobians are taken
  int detection_count = 0;
};

/// A known landmark: no part of the belief.
struct TeamAnchor {
  SmallVector position;  ///< world, m
  int detection_count = 0;
};

/// A detection and what was made of it.
struct Match {
  int vehicle = 0;
  bool of_vehicle = false;
  bool anchor = false;
  std::int64_t identity = 0;  ///< of the landmark that it was associated with; Detection::unknown: none
  SmallVector measured;       ///< as the sensor measures
  SmallVector predicted;  ///< before the update; empty where there was no prediction, or of a new landmark
  SmallMatrix innovation_cov;  ///< of the innovation, rows x rows; empty likewise
  MatchOutcome outcome = MatchOutcome::not_searched;
};

/// A position fix that corrected a vehicle.
struct UsedFix {
  int vehicle = 0;
  Eigen::Vector2d position{0.0, 0.0};  ///< world, m
  double sigma_m = 0;
};

/// The matches of a tick that passed the gate.
struct Inliers {
  std::vector<std::size_t> indices;                 ///< index of each in the estimate's list of looks
  std::vector<std::size_t> candidates;              ///< candidates for new landmarks, likewise
  std::vector<LinearizedMeasurement> measurements;  ///< each linearized about the means before the update
  Eigen::MatrixXd S;                                ///< innovation covariance of one
};

struct TeamEstimate {
  AnyBelief belief;
  bool started = false;
  std::vector<TeamVehicle> vehicles;
  std::optional<BlockId>
      world;  ///< pose of the world seen from the vehicle, where the map is in the vehicle's frame
  /// By identity, or by a number of the estimator's own where detections have none; anchors are not among them
  std::map<std::int64_t, TeamLandmark> landmarks;
  std::int64_t next_number = 0;  ///< of the estimator's own; none is given twice
  std::map<std::int64_t, TeamAnchor> anchors;
  TrackingStatus status;

  // Of the last tick
  std::vector<Match> matches;
  std::vector<UsedFix> fixes;
  Inliers inliers;  ///< kept so that a tick allocates nothing; for the estimator alone
  int matched = 0;
  UpdateReport update;
  bool refused = false;                        ///< an update or a fix could not be used within rounding
  bool association_capped = false;             ///< the joint search reached its cap
  int iterations = 0;                          ///< of the iterated update
  int doubted_ticks = 0, unmatched_ticks = 0;  ///< in a row
  double recent_nis = 0, recent_rows = 0;      ///< of the last updates, each counting 0.9 of the one after it
  Entropy entropy;                             ///< of all vehicles; of map and whole about once a second
  std::optional<double> entropy_t;             ///< s, when that was last
  std::int64_t unconverged_updates = 0;        ///< iterated updates that reached their cap so far
  std::int64_t capped_associations = 0;        ///< joint searches that reached theirs
  std::vector<std::pair<const char*, double>> timing_ms;
};

/// Position of a landmark in the world, as many numbers as the map has dimensions, and its covariance.
struct TeamPosition {
  SmallVector position;
  SmallMatrix covariance;
};
/// Nothing for an inverse depth that is not positive: the landmark may be at infinity.
std::optional<TeamPosition> position_of(const TeamLandmark& landmark, const TeamEstimate& estimate);

/// Entropies of the vehicles, the map and both: thesis (6.2). Cubic in the map, but linear where its correlations are
/// dropped.
Entropy entropies(const TeamEstimate& estimate);

}  // namespace incognita
