// Settings of the estimator: motion model, sensors and noise of each body, linearization, map frame and
// correlations, data association, anchors, and the limits of its health.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/math/setting.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_sensor.hpp"
#include "incognita/models/sensors/wheel_odometry.hpp"

namespace incognita {

/// A sensor that detects points, with its noise as the filter models it.
struct PointSensor {
  AnySensor sensor;
  SmallVector sigmas;            ///< one per row of a measurement
  double sigma_range_ratio = 0;  ///< times the first row of the measurement, a range, added to its sigma
  SensorLimits limits = {};      ///< predicted range and field of view
};

/// A body as the filter models it: motion, start and the sensors that it carries besides its cameras.
struct BodyModel {
  /// The time at which the body has its start pose.
  enum class StartTime {
    first_tick,
    first_reading,  ///< first odometry reading, if before the first tick
    first_fix,      ///< first position fix, which replaces the start position
  };
  /// The input of the prediction.
  enum class Input {
    measured,   ///< by odometry or by the body itself
    commanded,  ///< since the last tick; zero where a carrier is commanded
  };

  AnyMotion motion;
  std::vector<PointSensor> sensors;
  SmallVector start;         ///< state at the start
  SmallVector start_sigmas;  ///< one per error
  SmallVector input_sigmas;  ///< one per input, held over one reading or tick
  double sigma_fix_m = 0;    ///< of a position fix, per axis; 0: fixes are ignored
  StartTime start_time = StartTime::first_tick;
  Input input = Input::measured;
  /// Free cameras: wheel readings of the carrier correct the body's velocity and rate instead of moving it.
  std::optional<WheelOdometry> wheels = {};
};

/// A body with one sensor. `sigmas`: one per row of its measurement.
inline BodyModel body_with_sensor(const AnyMotion& motion, const AnySensor& sensor, const SmallVector& start,
                                  const SmallVector& start_sigmas, const SmallVector& input_sigmas,
                                  const SmallVector& sigmas) {
  BodyModel body;
  body.motion = motion;
  body.sensors.push_back({sensor, sigmas});
  body.start = start;
  body.start_sigmas = start_sigmas;
  body.input_sigmas = input_sigmas;
  return body;
}

/// Representation of the belief: the same estimate at different cost.
enum class BeliefForm { covariance, information };

/// Linearization of motion and measurements; it determines the filter.
enum class Linearization {
  analytic,           ///< extended Kalman filter
  iterated,           ///< each update is relinearized at its result
  unscented_vehicle,  ///< sigma points for the motion of the vehicle, otherwise as `analytic`
  first_estimate,     ///< Jacobians at the first estimates of vehicle and landmarks
  invariant           ///< as `analytic`, with errors that turn with the world: invariant_errors.hpp
};

/// Frame in which landmarks are expressed: the world, or the vehicle (thesis Section 3.2, third way).
enum class MapFrame { world, vehicle };

/// Blocks of the covariance that are made independent after each scan, thesis Section 3.3.
enum class Decorrelation {
  nothing,
  everything,
  map,        ///< landmarks from each other, with the least added trace
  map_linear  ///< the same in closed form, in time linear in the size of the map
};

struct MapperSettings {
  BeliefForm form = BeliefForm::covariance;
  Linearization linearization = Linearization::analytic;
  double gate_probability = 1;        ///< of a correct match; matches outside are outliers. 1: no gate
  double inverse_depth_per_m = 0.25;  ///< prior mean of the inverse depth, for sensors without range
  double sigma_inverse_depth_per_m = 0.25;
  /// Linearity index below which an inverse depth is converted to a point. 0.1 suffices for a single
  /// measurement, but a map accumulates the error of each.
  double max_linearity_index = 0.02;
  MapFrame map_frame = MapFrame::world;
  Decorrelation decorrelate = Decorrelation::nothing;
  bool entropy = true;  ///< whether the entropies are computed; else they are NaN
};

/// A setting that is incompatible with another.
struct FilterIncompatibility {
  const char* key;  ///< as written in a scenario
  const char* why;
};

/// The first incompatibility, if any.
inline std::optional<FilterIncompatibility> find_incompatibility(const MapperSettings& filter) {
  const bool in_vehicle_frame = filter.map_frame == MapFrame::vehicle;
  if (in_vehicle_frame && filter.linearization == Linearization::first_estimate)
    return {{"estimator.linearization",
             "first-estimate Jacobians need a map in the world frame, estimator.map_frame = `world`"}};
  if (in_vehicle_frame && filter.decorrelate != Decorrelation::nothing)
    return {{"estimator.decorrelate",
             "must be `nothing` with estimator.map_frame = `vehicle`: such a map moves as a whole"}};
  if (filter.linearization == Linearization::iterated && filter.decorrelate == Decorrelation::map_linear)
    return {
        {"estimator.decorrelate",
         "must not be `map-linear` with estimator.linearization = `iterated`: it uses measurements one after the "
         "other; take `map`"}};
  return std::nullopt;
}

/// Settings of data association.
struct DataAssociationSettings {
  enum class Method {
    known,    ///< by the identity that the sensor reports
    nearest,  ///< nearest neighbor
    joint     ///< joint compatibility branch and bound
  };
  Method method = Method::joint;
  double gate_probability = 0.95;
  std::int64_t max_nodes = 100000;
  double initialization_probability = 0.9999;
  double initialization_distance_m = 1.0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = DataAssociationSettings;
    setting(&S::method, "method", "", any(),
            "Data association by known identity, nearest neighbor or joint compatibility");
    setting(&S::gate_probability, "gate_probability", "", between(0.5, 1),
            "Probability that a correct match lies inside its gate; 1: no gate, with known identities only");
    setting(&S::max_nodes, "max_nodes", "", between(1, 1e9),
            "Limit of the nodes of the branch and bound search; reaching it is reported");
    setting(&S::initialization_probability, "initialization_probability", "", between(0.5, 0.999999999),
            "Gate of every landmark that a detection must lie outside of to initialize a new one");
    setting(&S::initialization_distance_m, "initialization_distance_m", "m", at_least(0),
            "Distance from every landmark that a new one must have");
  }
};

/// Which landmarks of point sensors without identities are deleted: prune_landmarks.hpp.
struct PruningSettings {
  int min_expected_scans = 20;    ///< before a landmark can be deleted
  double min_detected_share = 0;  ///< of these scans; 0: no landmark is deleted

  static void describe(auto&& setting) {
    using namespace limits;
    using S = PruningSettings;
    setting(&S::min_expected_scans, "min_expected_scans", "", between(1, 1000000),
            "Number of scans with a landmark predicted well in view before it can be deleted");
    setting(&S::min_detected_share, "min_detected_share", "", between(0, 1),
            "Share of these scans with a detection below which a landmark is deleted; 0: none is");
  }
};

/// The depth hypotheses of a new ray: depth_hypotheses.hpp.
struct DepthRange {
  int count = 100;
  double min_m = 0.5, max_m = 5;  ///< along the ray

  double spacing_m() const { return (max_m - min_m) / count; }
};

/// Delayed initialization of the landmarks that a camera detects as points: depth_lines.hpp.
struct DepthLineSettings {
  DepthRange range = {};
  double depth_ratio = 0.3;  ///< of the sigma of a depth to the depth; below, the landmark enters the map
  int max_failures = 10;     ///< consecutive ticks without a match, after which a line is dropped
};

/// Limits beyond which the estimate is degraded or lost, and the search after that.
struct HealthSettings {
  /// Of the position of any body in the world; beyond: lost. None by default: without a target, anchors or fixes that
  /// position is unobservable, and its sigma says nothing about the estimate.
  double max_sigma_position_m = 1e6;
  /// Of a body without a match: sigma of its position relative to what it matched last, over the distance; beyond: lost.
  double max_sigma_ratio = 0.5;
  int min_matches = 3;  ///< of a body with cameras, in a frame; with fewer it is degraded
  /// Of the features searched in a frame; with a smaller one the matches are taken as false, since in large search areas a few
  /// false ones agree by chance. After a frame below 1.6 times this share, 1.6 times as much is needed.
  double min_matched_share = 0.25;
  /// Consecutive frames with too few matches; or ticks with detections but no match, while `min_expected`
  /// landmarks are predicted in view; or ticks with innovations above `max_innovation_sigmas`: lost.
  int max_ticks = 10;
  int min_expected = 3;
  double max_innovation_sigmas = 10;  ///< rms normalized innovation, forgetting factor 0.9 per update
  int min_matches_to_relocate = 6;    ///< in one image, from lost: more than false matches give
  /// Lost: uncertainty of the search around the last pose.
  double sigma_search_position_m = 0.1, sigma_search_rotation_rad = 0.1;
  double sigma_search_velocity_m_s = 0.2, sigma_search_rate_rad_s = 0.2;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = HealthSettings;
    setting(
        &S::max_sigma_position_m, "max_sigma_position_m", "m", more_than(0),
        "Standard deviation of the position in the world above which the state is `lost`; by default without limit, "
        "because it may be unobservable");
    setting(
        &S::max_sigma_ratio, "max_sigma_ratio", "", more_than(0),
        "Standard deviation of the position relative to the landmarks matched last, over their distance, above which "
        "a body without matches is `lost`");
    setting(
        &S::max_ticks, "max_ticks", "", between(1, 100000),
        "Consecutive ticks with too few matches, or with too large innovations, after which the state is `lost`");
    setting(&S::max_innovation_sigmas, "max_innovation_sigmas", "", more_than(1),
            "Rms normalized innovation above which a tick counts towards `lost`; 1 is expected");
    setting(
        &S::min_matches, "min_matches", "", between(3, 10000),
        "Matches of a body with cameras, those of its other sensors included, below which a frame counts towards `lost`");
    setting(
        &S::min_matched_share, "min_matched_share", "", between(0, 1),
        "Share of the features searched in a frame below which its matches are taken as false; after a frame below "
        "1.6 times this share, that much is needed");
    setting(&S::min_matches_to_relocate, "min_matches_to_relocate", "", between(3, 10000),
            "Number of matches in one image that end the state `lost`");
    setting(
        &S::min_expected, "min_expected", "", between(1, 10000),
        "Landmarks predicted in view from which a tick with detections, but without a match, counts towards `lost`");
    setting(&S::sigma_search_position_m, "sigma_search_position_m", "m", above_up_to(0, 1000),
            "Standard deviation of the position for the search around the last pose in state `lost`");
    setting(&S::sigma_search_rotation_rad, "sigma_search_rotation_rad", "rad", above_up_to(0, 3.2),
            "Standard deviation of the rotation for the search around the last pose");
    setting(&S::sigma_search_velocity_m_s, "sigma_search_velocity_m_s", "m/s", above_up_to(0, 1000),
            "Standard deviation of the velocity for the search around the last pose");
    setting(&S::sigma_search_rate_rad_s, "sigma_search_rate_rad_s", "rad/s", above_up_to(0, 1000),
            "Standard deviation of the angular rate for the search around the last pose");
  }
};

struct EstimatorSettings {
  std::vector<BodyModel> bodies;
  MapperSettings filter;
  std::map<std::int64_t, SmallVector> anchors;  ///< landmarks at known positions
  DataAssociationSettings association = {.method = DataAssociationSettings::Method::known,
                                         .initialization_distance_m = 0};
  PruningSettings pruning = {};
  /// Of cameras that detect points. None: their landmarks enter the map at once, by their inverse depths.
  std::optional<DepthLineSettings> depth_lines = {};
  /// Landmarks that a camera is expected to detect, anchors and depth lines included, below which new ones are initialized; 0:
  /// all are.
  int wanted_visible = 0;
  HealthSettings health = {};
  /// Whether detections of anchors carry their identity. If not, anchors are associated like other landmarks.
  bool anchors_have_identity = true;
};

/// The reason why the settings are invalid; empty when they are valid.
std::string validate(const EstimatorSettings& settings);

}  // namespace incognita
