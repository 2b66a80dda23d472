// All that is known of a vehicle on a plane and its landmarks. Updated in place.
//
// The map is told in the world, or in the frame of the vehicle (Castellanos et al., "Robocentric map
// joining", RAS 2007; the third way of thesis Section 3.2). Then the belief holds how far the vehicle has
// come since the last tick, the world as the vehicle sees it, and the landmarks likewise; vehicle_pose() and
// position_of() hide which.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/models/planar_vehicle.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"
#include "incognita/slam/mapper/status.hpp"

namespace incognita {

struct PlanarLandmark {
  std::int64_t id = 0;  ///< the identity where association goes by it, else counted from 0
  bool anchor = false;
  std::int64_t identity = Detection::unknown;  ///< as the sensor tells it
  BlockId block = 0;                           ///< in the belief, unless an anchor
  Eigen::Vector2d position{0.0, 0.0};          ///< world, m: an anchor's; of others the first estimate
  int sightings = 0;
};

/// A detection and what was made of it.
struct PlanarLook {
  std::int64_t id = -1;  ///< of the landmark it was taken for; -1 for none
  bool anchor = false;
  Eigen::Vector2d measured{0.0, 0.0};   ///< range (m), bearing (rad)
  Eigen::Vector2d predicted{0.0, 0.0};  ///< of that landmark, before the update
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Zero();
  LookOutcome outcome = LookOutcome::not_tried;
};

/// A position fix that corrected the vehicle.
struct UsedFix {
  Eigen::Vector2d position{0.0, 0.0};  ///< world, m
  double sigma_m = 0;
};

struct PlanarEstimate {
  Belief belief;
  BlockId vehicle = 0;  ///< pose in the world, or since the last tick
  std::optional<BlockId>
      world;  ///< pose of the world seen from the vehicle; only where the map is told there
  bool started = false;
  double t = 0;                                    ///< s, of the last tick
  std::optional<Eigen::Vector2d> input;            ///< the last that the wheels told
  double input_t = 0;                              ///< s, when it did
  double input_period = 0;                         ///< s, between the last two readings; 0 before the second
  planar::Pose<double> first_prediction{0, 0, 0};  ///< of the vehicle at the last tick, before its update
  std::vector<PlanarLandmark> catalogue;
  std::int64_t next_id = 0;
  TrackingStatus status;

  // Of the last tick
  std::vector<PlanarLook> looks;
  std::vector<UsedFix> fixes;
  int matched = 0;
  UpdateReport update;
  bool refused = false;                ///< an update or a fix could not be used within rounding
  int iterations = 0;                  ///< of the iterated update
  std::int64_t unsettled_updates = 0;  ///< iterated updates that reached their cap so far
  bool association_capped = false;     ///< the joint search reached its cap
  std::int64_t capped_scans = 0;       ///< how many so far
  Entropy entropy;
  std::optional<double> entropy_t;  ///< s, when map and total were last computed
  std::vector<std::pair<const char*, double>> timing_ms;
};

struct PlanarPoseEstimate {
  planar::Pose<double> pose;  ///< world
  Eigen::Matrix3d covariance;
};
PlanarPoseEstimate vehicle_pose(const PlanarEstimate& estimate);

struct PlanarPosition {
  Eigen::Vector2d position;  ///< world, m
  Eigen::Matrix2d covariance;
};
/// Zero covariance for anchors.
PlanarPosition position_of(const PlanarLandmark& landmark, const PlanarEstimate& estimate);

/// Vehicle, map and both; of the blocks that are uncertain. Cubic in the map, but linear where its
/// correlations are dropped.
Entropy entropies(const PlanarEstimate& estimate);

}  // namespace incognita
