// The joint estimate of the bodies and of the landmarks that their sensors measure, updated in place.
//
// The map is expressed in the world or, for one vehicle on a plane, in the vehicle frame (Castellanos et al.,
// "Robocentric map joining", RAS 2007; the third way of thesis Section 3.2). In the latter case the belief
// consists of the motion of the vehicle since the last tick, the pose of the world relative to the vehicle,
// and landmarks relative to the vehicle; Body::pose and position_of() are in the world either way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/models/any_sensor.hpp"
#include "incognita/models/motion/planar_twist.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"
#include "incognita/slam/mapper/status.hpp"

namespace incognita {

/// What the assessment of a body remembers between ticks: health.hpp.
struct BodyHealth {
  int frames_with_few = 0;         ///< consecutive frames with too few matches, overdue ones too
  int unmatched_ticks = 0;         ///< consecutive ticks with detections but without a match
  std::optional<Readout> readout;  ///< of a rolling shutter, if the residuals of a camera show one
};

/// Numbers of the last tick of a body.
struct MatchCounts {
  int searched = 0;       ///< features searched for in its images
  int image_matches = 0;  ///< of them, those that updated the filter
  int matched = 0;        ///< the same with the detections of its other sensors
};

/// What a body matched, and how far away it was: relative_sigma.hpp.
struct MatchedTarget {
  bool of_body = false;  ///< `id` is the index of another body, not a landmark
  std::int64_t id = 0;
  double distance_m = 0;
};

struct Body {
  BlockId block = 0;
  SmallVector prediction;  ///< state after the last prediction, before the corrections of that tick
  double t = 0;            ///< s, time of the prediction
  /// s, of the position fix that is its start position, which is no measurement of it; none: it starts elsewhere
  std::optional<double> first_fix_t;
  std::optional<SmallVector> input;  ///< last odometry reading, held until the next
  std::optional<MeasuredTwist>
      twist;                ///< instead of the input, of that reading; of the point that is the state
  double input_t = 0;       ///< s, time of that reading
  double input_period = 0;  ///< s, between the last two readings; 0 before the second
  std::optional<Eigen::Vector2d> wheels;  ///< speed, m/s, turn rate, rad/s, of a camera's carrier

  // After the last tick, in the world
  SmallVector state;             ///< as defined by the motion model
  SmallMatrix state_covariance;  ///< of the state error
  RigidPose pose = {};           ///< as a rigid body in space
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of its error
  bool waits = false;  ///< lost, with no sensor but its cameras: not predicted until they recognize the map
  MatchCounts counts;
  TrackingStatus status;
  BodyHealth health;
  std::vector<MatchedTarget> matched_last;  ///< at the last tick with matches
  double start_sigma_m = 0;                 ///< of its position at the start, per axis
};

/// d(errors of a landmark) / d(turn of the world, rad, world axes).
using ByTurn = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 6, 3>;

struct Landmark {
  std::int64_t id = 0;
  bool fixed = false;  ///< an anchor: at a known position, not in the belief
  LandmarkParametrization form;
  BlockId block = 0;     ///< in the belief, unless fixed
  SmallVector position;  ///< world, m; of an anchor only
  SmallVector first;     ///< first estimate, for first-estimate Jacobians
  ByTurn by_turn;        ///< errors x 3, or empty: invariant_errors.hpp
  int detection_count = 0;
  int expected_scans = 0;  ///< of point sensors in which it was predicted well in view: prune_landmarks.hpp
  int detected_scans = 0;  ///< of them, those that detected it
  int camera = -1;         ///< index of the camera that tracks it by its appearance; -1: none
  Eigen::Vector3d first_view{0, 0, 0};  ///< world, m: from where that camera saw it first

  /// In the belief, with a position that its covariance describes.
  bool mapped() const { return !fixed && form.kind != LandmarkParametrization::Kind::ray; }
};

/// A depth hypothesis of a ray as predicted in the image.
struct DepthParticle {
  Eigen::Vector2d pixel{0.0, 0.0};
  double weight = 0;  ///< its probability before this match; those out of view are omitted
};

/// A measurement with its association.
struct Match {
  int body = 0;
  int sensor = 0;        ///< among the point sensors of the body, or with `image`, of all cameras
  bool of_body = false;  ///< the target is another body with index `id`, not a landmark
  bool anchor = false;
  bool image = false;   ///< found in an image; z is in pixels
  bool ray = false;     ///< of a landmark whose depth is a set of hypotheses; it does not correct the filter
  std::int64_t id = 0;  ///< of the associated landmark; Detection::unknown: none
  MeasurementVector measured;   ///< in the coordinates of the sensor; empty when the search found nothing
  MeasurementVector predicted;  ///< before the update; empty without a prediction and for new landmarks
  MeasurementMatrix innovation_cov;  ///< rows x rows; empty in the same cases
  double correlation = 0;            ///< images: normalized cross-correlation at the best match
  MatchOutcome outcome = MatchOutcome::not_searched;
  int first_particle = 0, particle_count = 0;  ///< of a ray: its hypotheses in FrameReport::particles
};

/// A position fix that was applied to a body.
struct UsedFix {
  int body = 0;
  Eigen::Vector2d position{0.0, 0.0};  ///< world, m
  double sigma_m = 0;
};

/// A pose of the past, world_from_body, as estimated now.
struct PastPose {
  double t = 0;  ///< s
  RigidPose pose;
};

/// Keyframes of the only body that were estimated again at this tick.
struct AdjustedKeyframes {
  RigidPose before;             ///< the pose of the body at this tick, before that
  std::vector<PastPose> poses;  ///< in time order; the last is that of this tick
};

/// The results of one tick.
struct FrameReport {
  std::vector<Match> matches;
  std::vector<DepthParticle> particles;  ///< of the rays among the matches, one after the other
  std::vector<UsedFix> fixes;
  int predicted = 0;      ///< landmarks searched for in the images, and detections of the other sensors
  int matched = 0;        ///< matches that updated the filter
  int image_matches = 0;  ///< matches in images that updated the filter
  std::optional<AdjustedKeyframes> adjusted;
  UpdateReport update;
  bool refused = false;             ///< an update or a fix was not usable within rounding
  bool association_capped = false;  ///< the joint search reached its node limit
  int iterations = 0;               ///< of the iterated update
  bool loop_closed = false;         ///< a drift was corrected, drift.hpp

  /// Back to the initial values; the memory of the lists is kept.
  void restart() {
    FrameReport next;
    next.matches.swap(matches);
    next.particles.swap(particles);
    next.fixes.swap(fixes);
    next.matches.clear();
    next.particles.clear();
    next.fixes.clear();
    *this = std::move(next);
  }
};

/// What the assessment of the joint updates remembers between ticks: health.hpp.
struct UpdateHealth {
  int doubted_ticks = 0;                   ///< consecutive ticks with matches and too large innovations
  double recent_nis = 0, recent_rows = 0;  ///< weighted sums over updates, forgetting factor 0.9
};

struct Estimate {
  AnyBelief belief;
  bool started = false;           ///< whether `belief` contains the bodies
  std::optional<double> first_t;  ///< s, of the first tick
  std::vector<Body> bodies;
  std::optional<BlockId> world;  ///< pose of the world in the vehicle frame; only for a map in that frame
  /// Blocks after the bodies that are no landmarks: errors of matches in images that last, lasting_errors.hpp.
  std::vector<BlockId> lasting_errors;
  /// By id: the identity that a sensor provides, or a number of the estimator. With the anchors.
  std::map<std::int64_t, Landmark> landmarks;
  std::int64_t next_id = 0;  ///< next number of the estimator; numbers are unique
  TrackingStatus status;     ///< of the body that is worst; each has its own
  UpdateHealth health;
  Entropy entropy;                  ///< entropy.hpp; NaN if switched off
  std::optional<double> entropy_t;  ///< s, the time that map and total stand for: at least one second apart
  FrameReport last;
  std::vector<std::pair<const char*, double>> timing_ms;

  /// The first body.
  const Body& body() const { return bodies.front(); }
  /// Mean of the first body, which must be a free camera.
  FreeCameraMotion::State<double> camera_state() const { return belief.mean(body().block); }
  /// Number of landmarks in the belief whose depth is known or Gaussian.
  int mapped_count() const {
    int count = 0;
    for (const auto& [id, landmark] : landmarks) count += landmark.mapped();
    return count;
  }
};

/// State of a body. An estimator of your own may set the status of the estimate only, for all bodies.
inline TrackingState state_of(const Estimate& estimate, std::size_t body) {
  const TrackingState own = estimate.bodies.at(body).status.state;
  return !estimate.started || own == TrackingState::starting ? estimate.status.state : own;
}
inline bool is_lost(const Estimate& estimate, std::size_t body) {
  return state_of(estimate, body) == TrackingState::lost;
}

/// First number of the features of cameras where point sensors report identities, which are smaller.
inline constexpr std::int64_t first_feature_number = 1'000'000'000;

/// The next number for a landmark without identity.
inline std::int64_t new_id(Estimate& estimate) {
  while (estimate.landmarks.contains(estimate.next_id)) ++estimate.next_id;
  return estimate.next_id++;
}

/// Position of a landmark in the world, in its own dimensions, and its covariance (zero for anchors).
struct LandmarkPosition {
  SmallVector position;
  SmallMatrix covariance;
};
/// Nothing unless the depth is Gaussian and positive: the landmark may be at infinity.
std::optional<LandmarkPosition> position_of(const Landmark& landmark, const Estimate& estimate);

}  // namespace incognita
