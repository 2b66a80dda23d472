// All that is known of a team of vehicles and of the landmarks they name: one belief. Updated in place.
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
  SmallVector prediction;            ///< state at the last tick, before its update
  double t = 0;                      ///< s, up to which it is predicted
  std::optional<SmallVector> input;  ///< the last that its wheels told, held until the next
  double input_t = 0;
  std::optional<Eigen::Vector2d> wheels;  ///< speed, m/s, and turn rate, rad/s, of what carries a camera
  double input_period = 0;                ///< s, between the last two readings; 0 before the second
  RigidPose pose = {};                    ///< as a body in space, after the last update
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of its error
};

struct TeamLandmark {
  std::int64_t identity = 0;
  LandmarkForm form;
  BlockId block = 0;
  SmallVector first;  ///< as it was born: where first-estimate Jacobians are taken
  int sightings = 0;
};

/// A landmark that was known before: no part of the belief.
struct TeamAnchor {
  SmallVector position;
  int sightings = 0;
};

/// A sighting and what was made of it.
struct TeamLook {
  int vehicle = 0;
  bool of_vehicle = false;
  bool anchor = false;
  std::int64_t identity = 0;  ///< what it was taken to be of; Detection::unknown: nothing
  SmallVector measured;       ///< as the sensor measures
  SmallVector predicted;  ///< before the update; empty where the sensor could not have it, or of a new one
  SmallMatrix innovation_cov;  ///< of the two's difference, rows x rows; empty likewise
  LookOutcome outcome = LookOutcome::not_tried;
};

/// Sightings of a tick that can be used.
struct UsedSightings {
  std::vector<std::size_t> told;       ///< where each is in the estimate's list of looks
  std::vector<std::size_t> newcomers;  ///< likewise of what landmarks may be born from
  std::vector<AffineLook> looks;       ///< what each is to the engine, about the means before the update
  Eigen::MatrixXd S;                   ///< innovation covariance of one
};

struct TeamEstimate {
  AnyBelief belief;
  bool started = false;
  std::vector<TeamVehicle> vehicles;
  /// By identity, or by a number of the estimator's own where sightings have none; anchors are not among them
  std::map<std::int64_t, TeamLandmark> landmarks;
  std::int64_t next_number = 0;  ///< of the estimator's own; none is given twice
  std::map<std::int64_t, TeamAnchor> anchors;
  TrackingStatus status;

  // Of the last tick
  std::vector<TeamLook> looks;
  UsedSightings used;  ///< kept so that a tick allocates nothing; for the estimator alone
  int matched = 0;
  UpdateReport update;
  int doubted_ticks = 0, unmatched_ticks = 0;  ///< in a row
  double recent_nis = 0, recent_rows = 0;      ///< of the last updates, each counting 0.9 of the one after it
  Entropy entropy;                             ///< of all vehicles; of map and whole about once a second
  std::optional<double> entropy_t;             ///< s, when that was last
  std::int64_t unsettled_updates = 0;          ///< iterated updates that reached their cap so far
  std::vector<std::pair<const char*, double>> timing_ms;
};

}  // namespace incognita
