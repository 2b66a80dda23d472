// The estimator of one camera that moves freely: thesis Appendix C.
#pragma once

#include <cstdint>
#include <optional>

#include "incognita/models/sensors/wheel_odometry.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {

/// `target` defines world frame and scale; without one the first view is the origin and the scale is that
/// of the depth prior. `odometry`: model of the carrier's wheel odometry, if it is to be used. `filter`: of the back
/// end. Throws std::invalid_argument, with the key of the scenario file and the value, for the first invalid setting.
SlamEstimator single_camera(Camera camera, const std::optional<Target>& target,
                            const CameraSlamSettings& settings, double max_search_s, std::uint64_t seed,
                            const std::optional<WheelOdometry>& odometry = {},
                            const MapperSettings& filter = {});

/// The model of a free camera that starts at the origin, level, looking along x, until a target says where it is.
BodyModel free_camera_body(const FilterSettings& settings);

}  // namespace incognita
