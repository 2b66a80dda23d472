// Consistency of the planar filters on a simulated loop: the same drives, every filter, many seeds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/world/points/planar_loop.hpp"

namespace incognita {

/// A filter as the table names it, and what makes it so. All are given the noises that the drive truly has.
struct PlanarFilterChoice {
  std::string name;
  PlanarFilterSettings filter;
};
std::vector<PlanarFilterChoice> planar_filter_choices();

/// The landmarks that are estimated, at one time: rms of their errors and of their sigmas, m.
struct LandmarksAtOnce {
  double error_m = 0, sigma_m = 0;
};

/// Of one drive, averaged over its scans unless said.
struct PlanarConsistency {
  double nees = 0;  ///< of the pose, per degree of freedom: 1 is right
  double nis = 0;   ///< of the innovations, likewise
  double position_rms_m = 0;
  double heading_rms_rad = 0;
  double fitted_position_rms_m = 0;  ///< after a rigid fit of the path
  double position_sigma_m = 0;       ///< rms, by the filter
  LandmarksAtOnce at_half, at_end;
};
/// Anchors of the filter, if any, are the first landmarks of the drive, in their order. The first heading is drawn
/// with the sigma that the filter is given; 0: it is known.
PlanarConsistency planar_consistency(const PlanarLoopSettings& drive, std::uint64_t seed,
                                     const PlanarFilterSettings& filter, double sigma_first_heading_rad = 0);

/// The drives of the table are those of the seeds after this.
inline constexpr std::uint64_t first_consistency_seed = 1000;

inline constexpr double standing_sigma_heading_deg = 15;
inline constexpr int standing_measurements = 500;

/// A stationary vehicle at the origin, heading along x, that measures one landmark 10 m ahead repeatedly, its
/// range to 0.1 m.
struct StandingSettings {
  Linearization linearization = Linearization::analytic;
  planar::Pose<double> first_estimate = planar::Pose<double>::Zero();
  double sigma_position_m = 0, sigma_heading_deg = standing_sigma_heading_deg, sigma_bearing_deg = 1;
  int measurements = standing_measurements;
};
struct StandingVehicle {
  double sigma_heading_deg = 0;  ///< at the end
  double nees = 0;               ///< of the heading at the end
};
StandingVehicle standing_vehicle(const StandingSettings& settings, RandomStream& random);
/// At a known position, with a first heading drawn.
StandingVehicle standing_vehicle(std::uint64_t seed, Linearization linearization,
                                 int measurements = standing_measurements);

}  // namespace incognita
