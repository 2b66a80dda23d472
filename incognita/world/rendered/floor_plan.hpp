// Floor plan of the rendered room: obstacles of a vehicle and distances to them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

class FloorPlan {
 public:
  explicit FloorPlan(const RoomLayout& layout);

  /// Distance to the nearest wall or box, m; 0 inside a box and outside the walls.
  double clearance_at(const Eigen::Vector2d& position) const;

  /// Distance to the nearest wall or box within `half_width_rad` of a direction from +x, m; `reach_m` if
  /// there is none nearer.
  double clearance_towards(const Eigen::Vector2d& position, double direction_rad, double half_width_rad,
                           double reach_m) const;

 private:
  using Side = std::array<Eigen::Vector2d, 2>;

  Box inside_;
  std::vector<Box> boxes_;
  std::vector<Side> sides_;  ///< edges of walls and boxes
};

/// Ring of adjacent cones around a vehicle, like a ring of sonars.
struct RangeRing {
  int cones = 24;
  double reach_m = 4;
  double sigma_m = 0.01;
};

/// Ranges without noise. `heading_rad`: of the vehicle.
std::vector<ConeRange> measure_ranges(const FloorPlan& plan, const RangeRing& ring,
                                      const Eigen::Vector2d& position, double heading_rad);

}  // namespace incognita
