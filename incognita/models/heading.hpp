// Where a camera looks, seen on the map.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// The camera's heading: the angle about the world's z axis of its optical axis, from +x, rad. For a camera
/// that looks straight up or down, that of its upper or lower image edge.
double heading_of(const Eigen::Vector4d& world_from_camera);

/// A level camera looking along a heading (rad, about z from +x): world_from_camera.
Eigen::Vector4d level_gaze(double heading_rad);

}  // namespace incognita
