// Settings of the estimator: motion model, sensors and noise of each body, linearization, map frame and
// correlations, data association, anchors, and the limits of its health.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_sensor.hpp"
#include "incognita/models/wheel_odometry.hpp"

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

struct MapperSettings {
  std::string form = "covariance";         ///< `covariance` or `information`: same estimate, different cost
  std::string linearization = "analytic";  ///< `analytic`, `iterated`, `unscented-vehicle`, `first-estimate`
  double gate_probability = 1;             ///< of a correct match; matches outside are outliers. 1: no gate
  double inverse_depth_per_m = 0.25;       ///< prior mean of the inverse depth, for sensors without range
  double sigma_inverse_depth_per_m = 0.25;
  /// Linearity index below which an inverse depth is converted to a point. 0.1 suffices for a single
  /// measurement, but a map accumulates the error of each.
  double max_linearity_index = 0.02;
  std::string map_frame = "world";      ///< `world`, or `vehicle`: thesis Section 3.2, third way
  std::string decorrelate = "nothing";  ///< `nothing`, `everything`, `map`, `map-linear`: thesis Section 3.3
};

/// A setting that is incompatible with another.
struct FilterIncompatibility {
  const char* key;  ///< as written in a scenario
  const char* why;
};

/// The first incompatibility, if any.
inline std::optional<FilterIncompatibility> find_incompatibility(const MapperSettings& filter) {
  const bool in_vehicle_frame = filter.map_frame == "vehicle";
  if (in_vehicle_frame && filter.linearization == "first-estimate")
    return {{"vehicle_filter.lineariser",
             "first-estimate Jacobians need a map in the world frame, vehicle_filter.map_frame = `world`"}};
  if (in_vehicle_frame && filter.decorrelate != "nothing")
    return {{"vehicle_filter.decorrelate",
             "must be `nothing` with vehicle_filter.map_frame = `vehicle`: such a map moves as a whole"}};
  if (filter.linearization == "iterated" && filter.decorrelate == "map-linear")
    return {
        {"vehicle_filter.decorrelate",
         "must not be `map-linear` with vehicle_filter.lineariser = `iterated`: it uses measurements one after the "
         "other; take `map`"}};
  return std::nullopt;
}

/// Settings of data association.
struct DataAssociationSettings {
  std::string method = "joint";                ///< `known` (by identity), `nearest` or `joint`
  double gate_probability = 0.95;              ///< `nearest`, `joint`: of a correct match
  std::int64_t max_nodes = 100000;             ///< `joint`: limit of the branch and bound search
  double initialization_probability = 0.9999;  ///< gate of new landmarks: outside of it for all landmarks
  double initialization_distance_m = 1.0;      ///< and at least this far from every landmark; 0: no limit
};

/// Limits beyond which the estimate is degraded or lost, and the search after that.
struct HealthSettings {
  double max_sigma_position_m = 10;  ///< of any body; beyond: lost
  int min_matches = 3;               ///< in the images of a frame; with fewer the estimate is degraded
  /// Consecutive frames with too few matches; or ticks with detections but no match, while `min_expected`
  /// landmarks are predicted in view; or ticks with innovations above `max_innovation_sigmas`: lost.
  int max_ticks = 10;
  int min_expected = 3;
  double max_innovation_sigmas = 10;  ///< rms normalized innovation, forgetting factor 0.9 per update
  int min_matches_to_relocate = 6;    ///< in one image, from lost: more than false matches give
  /// Lost: uncertainty of the search around the last pose.
  double sigma_search_position_m = 0.1, sigma_search_rotation_rad = 0.1;
  double sigma_search_velocity_m_s = 0.2, sigma_search_rate_rad_s = 0.2;
};

struct EstimatorSettings {
  std::vector<BodyModel> bodies;
  MapperSettings filter;
  std::map<std::int64_t, SmallVector> anchors;  ///< landmarks at known positions
  DataAssociationSettings association = {.method = "known", .initialization_distance_m = 0};
  HealthSettings health = {};
  /// Whether detections of anchors carry their identity. If not, anchors are associated like other landmarks.
  bool anchors_have_identity = true;
};

/// The reason why the settings are invalid; empty when they are valid.
std::string validate(const EstimatorSettings& settings);

}  // namespace incognita
