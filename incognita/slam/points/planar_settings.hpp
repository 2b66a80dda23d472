// Settings of the planar estimator. Every field is one key of a scenario file; units are in the names.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

struct VehicleSettings {
  std::string model = "ackermann";  ///< name of a motion model: models/registry.hpp
  double wheelbase_m = 2.83;        ///< `ackermann`
  double wheel_left_m = 0.76;       ///< `ackermann`: from the middle of the rear axle to the measured wheel
  double sensor_forward_m = 0;      ///< sensor from the middle of the rear (or only) axle
  double sensor_left_m = 0;
  double sigma_speed_m_s = 0.7;                   ///< of the measured speed, held for one reading
  double sigma_steering_rad = 0.12217;            ///< `ackermann`
  double sigma_turn_rate_rad_s = 0.05;            ///< `differential-drive`
  std::map<std::string, double> parameters = {};  ///< of other motion models, by key

  /// The parameter with this key, as declared by the motion models. A new one is set to `default_value`.
  double& parameter(const std::string& key, double default_value) {
    if (key == "wheelbase_m") return wheelbase_m;
    if (key == "wheel_left_m") return wheel_left_m;
    if (key == "sensor_forward_m") return sensor_forward_m;
    if (key == "sensor_left_m") return sensor_left_m;
    return parameters.emplace(key, default_value).first->second;
  }
};

/// The motion model with its parameters and level ground. Throws std::invalid_argument for an unknown model.
AnyMotion motion_of(const VehicleSettings& settings);
/// The sigma of each input of the motion model.
SmallVector input_sigmas_of(const VehicleSettings& settings, const MotionTraits& motion);

struct RangeBearingSettings {
  double sigma_range_m = 0.1;
  double sigma_range_ratio = 0;  ///< times the range, added to sigma_range_m
  double sigma_bearing_rad = 0.0174533;
  double max_range_m = 80;  ///< more distant detections are ignored
};

struct PlanarFilterSettings {
  std::string linearization = "analytic";  ///< `analytic`, `iterated`, `unscented-vehicle`, `first-estimate`
  std::string map_frame = "world";       ///< frame of the landmarks, `world` or `vehicle`: thesis Section 3.2
  std::string decorrelate = "nothing";   ///< `nothing`, `everything`, `map`, `map-linear`: thesis Section 3.3
  std::vector<Eigen::Vector2d> anchors;  ///< known landmarks, world, m
  bool use_fixes = false;                ///< position fixes of an external sensor correct the vehicle
  double sigma_fix_m = 0.1;
};

struct PlanarStartSettings {
  Eigen::Vector2d position_m{0.0, 0.0};
  double heading_rad = 0;
  bool at_first_fix = false;  ///< the first position fix replaces position_m
  double sigma_position_m = 0;
  double sigma_heading_rad = 0;
};

struct PlanarLostSettings {
  double max_sigma_position_m = 10;  ///< upper limit of the position sigma
  /// Consecutive scans with detections, none of which matches a landmark predicted in view.
  int max_unmatched_scans = 10;
};

struct PlanarSlamSettings {
  VehicleSettings vehicle;
  RangeBearingSettings sensor;
  PlanarFilterSettings filter;
  DataAssociationSettings association;
  PlanarStartSettings start;
  PlanarLostSettings lost;
};

inline std::optional<FilterIncompatibility> find_incompatibility(const PlanarFilterSettings& filter) {
  MapperSettings same;
  same.linearization = filter.linearization;
  same.map_frame = filter.map_frame;
  same.decorrelate = filter.decorrelate;
  return find_incompatibility(same);
}

}  // namespace incognita
