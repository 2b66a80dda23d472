// The rendered room seen from above: what a vehicle on its floor can bump into, and how far off it is.
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

  /// How far it is to the nearest wall or box, m; 0 inside a box and outside the walls.
  double clearance_at(const Eigen::Vector2d& position) const;

  /// How far it is to the nearest wall or box within `half_width_rad` of a direction from +x; `reach_m` where
  /// there is none so near.
  double clearance_towards(const Eigen::Vector2d& position, double direction_rad, double half_width_rad,
                           double reach_m) const;

 private:
  using Side = std::array<Eigen::Vector2d, 2>;

  Box inside_;
  std::vector<Box> boxes_;
  std::vector<Side> sides_;  ///< of walls and boxes
};

/// So many cones side by side all around a vehicle, as a ring of sonars has them.
struct RangeRing {
  int cones = 24;
  double reach_m = 4;
  double sigma_m = 0.01;
};

/// Free of noise. `heading_rad` is the vehicle's.
std::vector<ConeRange> measure_ranges(const FloorPlan& plan, const RangeRing& ring,
                                      const Eigen::Vector2d& position, double heading_rad);

}  // namespace incognita
