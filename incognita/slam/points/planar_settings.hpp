// What can be set on the planar estimator. Every field is one key of a scenario file; units are in the names.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace incognita {

struct VehicleSettings {
  std::string model = "ackermann";  ///< `ackermann` or `differential-drive`
  double wheelbase_m = 2.83;        ///< `ackermann`
  double wheel_left_m = 0.76;       ///< `ackermann`: from the middle of the rear axle to the wheel measured
  double sensor_forward_m = 0;      ///< sensor from the middle of the rear or only axle
  double sensor_left_m = 0;
  double sigma_speed_m_s = 0.7;  ///< of the speed that the wheel or the axle tells, held for one reading
  double sigma_steering_rad = 0.12217;  ///< `ackermann`
  double sigma_turn_rate_rad_s = 0.05;  ///< `differential-drive`
};

struct RangeBearingSettings {
  double sigma_range_m = 0.1;
  double sigma_range_ratio = 0;  ///< added to it, times the range
  double sigma_bearing_rad = 0.0174533;
  double max_range_m = 80;  ///< farther detections are left out
};

struct PlanarFilterSettings {
  std::string lineariser = "analytic";  ///< `analytic`, `iterated`, `unscented-vehicle`, `first-estimate`
  std::string map_frame = "world";  ///< `world` or `vehicle`: where landmarks are told, thesis Section 3.2
  std::string decorrelate = "nothing";   ///< `nothing`, `everything`, `map`, `map-linear`: thesis Section 3.3
  std::vector<Eigen::Vector2d> anchors;  ///< known landmarks, world, m
  bool use_fixes = false;                ///< whether an external sensor sees the vehicle
  double sigma_fix_m = 0.1;
};

struct DataAssociationSettings {
  std::string method = "joint";       ///< `known`, `nearest` or `joint`
  double gate_probability = 0.95;     ///< of a right pairing
  std::int64_t max_nodes = 100000;    ///< of the joint search
  double birth_probability = 0.9999;  ///< a detection outside this gate of every landmark is of a new one
  double birth_distance_m = 1.0;      ///< and at least so far from every landmark
};

struct PlanarStartSettings {
  Eigen::Vector2d position_m{0.0, 0.0};
  double heading_rad = 0;
  bool at_first_fix = false;  ///< the position is the first that the external sensor gives
  double sigma_position_m = 0;
  double sigma_heading_rad = 0;
};

struct PlanarLostSettings {
  double max_sigma_position_m = 10;  ///< beyond, lost whatever matches
  int max_unmatched_scans = 10;      ///< so many scans in a row that show landmarks, none of them known: lost
};

struct PlanarSlamSettings {
  VehicleSettings vehicle;
  RangeBearingSettings sensor;
  PlanarFilterSettings filter;
  DataAssociationSettings association;
  PlanarStartSettings start;
  PlanarLostSettings lost;
};

/// A setting that makes no sense with another.
struct PlanarFilterConflict {
  const char* key;  ///< as a scenario writes it
  const char* why;
};

/// The first conflict, if there is one.
inline std::optional<PlanarFilterConflict> conflict_in(const PlanarFilterSettings& filter) {
  const bool from_vehicle = filter.map_frame == "vehicle";
  if (from_vehicle && filter.lineariser == "first-estimate")
    return {{"vehicle_filter.lineariser",
             "first-estimate Jacobians belong to a map told in the world, vehicle_filter.map_frame"}};
  if (from_vehicle && filter.decorrelate != "nothing")
    return {{"vehicle_filter.decorrelate",
             "must be `nothing` with vehicle_filter.map_frame = `vehicle`: such a map moves as a whole"}};
  if (filter.lineariser == "iterated" && filter.decorrelate == "map-linear")
    return {
        {"vehicle_filter.decorrelate",
         "must not be `map-linear` with vehicle_filter.lineariser = `iterated`: it uses looks one after the "
         "other; take `map`"}};
  return std::nullopt;
}

}  // namespace incognita
