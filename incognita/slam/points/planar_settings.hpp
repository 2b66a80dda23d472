// Settings of the estimator of one planar vehicle.
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
  std::string model = "ackermann";
  double sigma_speed_m_s = 0.7;
  double sigma_steering_rad = 0.12217;
  double sigma_turn_rate_rad_s = 0.05;
  /// Of the motion model, by key, e.g. wheelbase_m; those not given have the defaults of the model.
  std::map<std::string, double> parameters = {};

  double parameter(const std::string& key, double default_value = 0) const {
    const auto given = parameters.find(key);
    return given == parameters.end() ? default_value : given->second;
  }

  /// The parameters are declared by the motion models: models/registry.hpp.
  static void describe(auto&& setting) {
    using namespace limits;
    using S = VehicleSettings;
    setting(&S::model, "model", "", any(), "Motion model, and meaning of the odometry");
    setting(&S::sigma_speed_m_s, "sigma_speed_m_s", "m/s", between(0, 1000),
            "Standard deviation of the speed, constant over one reading");
    setting(&S::sigma_turn_rate_rad_s, "sigma_turn_rate_rad_s", "rad/s", between(0, 1000),
            "Standard deviation of the turn rate, constant over one reading");
    setting(&S::sigma_steering_rad, "sigma_steering_rad", "rad", between(0, 3.2),
            "Standard deviation of the steering angle, constant over one reading");
  }
};

/// The motion model with its parameters and level ground. Throws std::invalid_argument for an unknown model.
AnyMotion motion_of(const VehicleSettings& settings);
/// The sigma of each input of the motion model.
SmallVector input_sigmas_of(const VehicleSettings& settings, const MotionTraits& motion);

struct RangeBearingSettings {
  double sigma_range_m = 0.1;
  double sigma_range_ratio = 0;
  double sigma_bearing_rad = 0.0174533;
  double max_range_m = 80;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = RangeBearingSettings;
    setting(&S::sigma_range_m, "sigma_range_m", "m", above_up_to(0, 1000),
            "Standard deviation of one range measurement");
    setting(&S::sigma_range_ratio, "sigma_range_ratio", "", between(0, 1),
            "Share of the range that is added to the standard deviation of a range measurement");
    setting(&S::sigma_bearing_rad, "sigma_bearing_rad", "rad", above_up_to(0, 3.2),
            "Standard deviation of one bearing measurement");
    setting(&S::max_range_m, "max_range_m", "m", above_up_to(0, 1e6),
            "Range beyond which detections are ignored");
  }
};

struct PlanarFilterSettings {
  Linearization linearization = Linearization::analytic;
  MapFrame map_frame = MapFrame::world;
  Decorrelation decorrelate = Decorrelation::nothing;
  std::vector<Eigen::Vector2d> anchors;
  bool use_fixes = false;
  double sigma_fix_m = 0.1;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = PlanarFilterSettings;
    setting(&S::linearization, "linearization", "", any(), "Linearization of motion and measurements");
    setting(&S::map_frame, "map_frame", "", any(),
            "Frame in which landmarks are expressed, thesis Section 3.2");
    setting(&S::decorrelate, "decorrelate", "", any(),
            "Blocks of the covariance made independent after each scan by inflation, thesis Section 3.3");
    setting(&S::anchors, "anchors_m", "m", between(-1e9, 1e9), "Landmarks at known positions, [x, y] each");
    setting(
        &S::use_fixes, "use_fixes", "", any(),
        "Whether the position fixes of an external sensor such as GPS correct the vehicle during the run");
    setting(&S::sigma_fix_m, "sigma_fix_m", "m", above_up_to(0, 1e6),
            "Standard deviation of one position fix, per axis");
  }
};

struct PlanarStartSettings {
  Eigen::Vector2d position_m{0.0, 0.0};
  double heading_rad = 0;
  bool at_first_fix = false;
  double sigma_position_m = 0;
  double sigma_heading_rad = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = PlanarStartSettings;
    setting(&S::position_m, "position_m", "m", between(-1e9, 1e9), "Initial position of the sensor, [x, y]");
    setting(&S::heading_rad, "heading_rad", "rad", between(-6.3, 6.3),
            "Initial heading about z, from the x axis");
    setting(&S::at_first_fix, "at_first_fix", "", any(),
            "Whether the first position fix of an external sensor gives the initial position");
    setting(&S::sigma_position_m, "sigma_position_m", "m", between(0, 1e6),
            "Standard deviation of the initial position, per axis");
    setting(&S::sigma_heading_rad, "sigma_heading_rad", "rad", between(0, 6.3),
            "Standard deviation of the initial heading");
  }
};

struct PlanarSlamSettings {
  VehicleSettings vehicle;
  RangeBearingSettings sensor;
  PlanarFilterSettings filter;
  DataAssociationSettings association;
  PruningSettings pruning;
  PlanarStartSettings start;
  HealthSettings health;
  bool entropy = true;  ///< whether the entropies are computed
};

inline std::optional<FilterIncompatibility> find_incompatibility(const PlanarFilterSettings& filter) {
  MapperSettings same;
  same.linearization = filter.linearization;
  same.map_frame = filter.map_frame;
  same.decorrelate = filter.decorrelate;
  return find_incompatibility(same);
}

}  // namespace incognita
