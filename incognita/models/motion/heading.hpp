// Heading of a camera.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Heading of the optical axis about the world's z axis, from +x, rad. For a camera that looks nearly
/// straight up or down, that of its lower or upper image edge.
double heading_of(const Eigen::Vector4d& world_from_camera);

/// world_from_camera of a level camera with this heading (rad, about z from +x).
Eigen::Vector4d level_gaze(double heading_rad);

/// world_from_camera of a camera that does not roll. `elevation_rad`: of the optical axis above the horizon.
Eigen::Vector4d gaze_at(double heading_rad, double elevation_rad);
/// Elevation of the optical axis above the horizon, rad.
double elevation_of(const Eigen::Vector4d& world_from_camera);

}  // namespace incognita
