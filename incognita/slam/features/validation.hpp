// Validation of the settings of a camera.
#pragma once

#include <optional>

#include "incognita/models/sensors/wheel_odometry.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/slam/features/target.hpp"

namespace incognita {

/// Throws std::invalid_argument, with the key of the scenario file and the value, for the first invalid setting.
void validate(const CameraSlamSettings& settings, const std::optional<Target>& target, double max_search_s);
void validate(const WheelOdometry& odometry);

}  // namespace incognita
