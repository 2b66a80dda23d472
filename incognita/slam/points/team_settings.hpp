// The settings of an estimator of one or several vehicles: the motion model, the sensor and the noises of each, the
// linearization, the frame and the correlations of the map, data association, and known landmarks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/any_sensor.hpp"

namespace incognita {

struct TeamMember {
  /// The time at which the vehicle has its start pose.
  enum class StartTime {
    first_tick,
    first_reading,  ///< the first odometry reading, where that comes before the first tick
    first_fix,      ///< the first position fix, which replaces the start position
  };

  AnyMotion motion;
  AnySensor sensor;
  SmallVector start;             ///< state at the start
  SmallVector start_sigmas;      ///< one per error
  SmallVector input_sigmas;      ///< of each input, held over one reading or tick
  SmallVector sigmas;            ///< of each number of a measurement
  double sigma_range_ratio = 0;  ///< added to the first of them, times the measurement: of ranges
  double sigma_fix_m = 0;        ///< of a position fix, per axis; 0: fixes do not correct the vehicle
  StartTime start_time = StartTime::first_tick;
  SensorLimits reach = {};  ///< beyond, landmarks are not expected to be measured
};

struct TeamFilterSettings {
  std::string form = "covariance";  ///< `covariance` or `information`: the same estimate at another cost
  std::string linearization = "analytic";  ///< `analytic`, `iterated`, `unscented-vehicle`, `first-estimate`
  double gate_probability = 1;             ///< of a correct match; matches outside are outliers. 1: no gate
  double inverse_depth_per_m = 0.25;  ///< mean of the inverse depth of a landmark seen in a direction only
  double sigma_inverse_depth_per_m = 0.25;
  /// Linearity index below which an inverse depth becomes a point. 0.1 suffices for a single measurement, but a map
  /// accumulates the error of each.
  double max_linearity_index = 0.02;
  std::string map_frame = "world";      ///< `world`, or `vehicle`: thesis Section 3.2, third way
  std::string decorrelate = "nothing";  ///< `nothing`, `everything`, `map`, `map-linear`: thesis Section 3.3
};

/// A setting that is incompatible with another.
struct FilterIncompatibility {
  const char* key;  ///< as a scenario writes it
  const char* why;
};

/// The first of them, if there is one.
inline std::optional<FilterIncompatibility> find_incompatibility(const TeamFilterSettings& filter) {
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

/// Which landmark a detection is of.
struct DataAssociationSettings {
  std::string method = "joint";     ///< `known` (by identity), `nearest` or `joint`
  double gate_probability = 0.95;   ///< `nearest`, `joint`: of a correct match
  std::int64_t max_nodes = 100000;  ///< `joint`: of the branch and bound search
  double initialization_probability =
      0.9999;  ///< a detection outside this gate of every landmark is a new landmark
  double initialization_distance_m = 1.0;  ///< and at least this far from every landmark; 0: no such limit
};

/// When the estimate is lost.
struct TeamLostSettings {
  double max_sigma_position_m = 10;  ///< of any vehicle
  /// Ticks in a row with detections of which none is matched, while `min_expected` mapped landmarks are predicted in
  /// view; or with innovations above `max_innovation_sigmas`
  int max_ticks = 10;
  int min_expected = 3;
  double max_innovation_sigmas = 10;  ///< rms of the normalized innovations of the last ten or so updates
};

struct TeamSettings {
  std::vector<TeamMember> members;
  TeamFilterSettings filter;
  std::map<std::int64_t, SmallVector> anchors;  ///< known landmarks: a whole map, or those that fix the frame
  DataAssociationSettings association = {.method = "known", .initialization_distance_m = 0};
  TeamLostSettings lost = {};
  /// Whether detections of anchors carry their number as identity. Without it anchors are associated as other
  /// landmarks are.
  bool anchors_have_identity = true;
};

}  // namespace incognita
