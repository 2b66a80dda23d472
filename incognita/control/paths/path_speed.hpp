// Speed and acceleration that a path demands of a vehicle.
#pragma once

#include <optional>
#include <string>

#include "incognita/control/paths/reference_path.hpp"

namespace incognita {

struct PathSpeed {
  double m_s = 0;
  double t_s = 0;  ///< first time at which it occurs
};

/// Maximum speed over the whole path.
PathSpeed greatest_speed(const Path& path);

/// Reason why a vehicle with that top speed cannot follow the path; empty if it can. It needs a speed margin
/// to make up an initial error.
std::optional<std::string> unreachable(const Path& path, double max_speed_m_s);

struct PathAcceleration {
  double m_s2 = 0;    ///< along any axis of the world
  double rad_s2 = 0;  ///< heading acceleration; steps at standstill are not counted
};

/// Maximum accelerations over the whole path.
PathAcceleration greatest_acceleration(const Path& path);

}  // namespace incognita
