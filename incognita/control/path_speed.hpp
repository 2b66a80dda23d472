// Whether a vehicle is fast and strong enough for a path.
#pragma once

#include <optional>
#include <string>

#include "incognita/control/reference_path.hpp"

namespace incognita {

struct PathSpeed {
  double m_s = 0;
  double t_s = 0;  ///< when it is asked for first
};

/// The highest speed that the path asks for, over all of its duration.
PathSpeed greatest_speed(const Path& path);

/// Why a vehicle with that top speed cannot keep up; nothing when it can. It needs some speed in hand to
/// catch up from where it starts.
std::optional<std::string> unreachable(const Path& path, double max_speed_m_s);

struct PathAcceleration {
  double m_s2 = 0;    ///< along any axis of the world
  double rad_s2 = 0;  ///< of the heading; one that changes at once, where the path stands, is not counted
};

/// The highest accelerations that the path asks for, over all of its duration.
PathAcceleration greatest_acceleration(const Path& path);

}  // namespace incognita
