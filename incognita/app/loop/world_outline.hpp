// The surroundings of a run as the recorder describes them, for drawing.
#pragma once

#include <optional>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/models/motion/terrain.hpp"
#include "incognita/record/summary/run_info.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

CameraIntrinsics intrinsics_of(const CameraSettings& camera);
RoomOutline outline_of(const RoomLayout& layout);

/// Heights between two corners of the plane, at most 64 by 64. Empty if the ground is the plane z = 0 there.
std::optional<TerrainGrid> terrain_grid(const Terrain& ground, const Eigen::Vector2d& min_m,
                                        const Eigen::Vector2d& max_m);

/// Mean rate of a recording's times, s; empty with fewer than two.
std::optional<double> mean_rate_hz(const std::vector<double>& times);

}  // namespace incognita
