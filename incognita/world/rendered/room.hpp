// The rendered room as data: its layout and its textures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/world/rendered/ground.hpp"
#include "incognita/world/rendered/room_layout.hpp"
#include "incognita/world/rendered/texture.hpp"

namespace incognita {

/// One axis-aligned flat surface. Its texture is not mirrored when seen from the front.
struct RoomSurface {
  Texture texture;
  /// Texel coordinates of a point P: u = u_per_m * P[a] + u_at_0 and v = v_per_m * P[b] + v_at_0, with a, b
  /// the two in-plane axes in rising order.
  float u_per_m = 1, u_at_0 = 0, v_per_m = 1, v_at_0 = 0;
  float light = 1;  ///< fraction of the light that reaches this side
};

/// Six surfaces of a box: index 2 * axis + 1 is the upper end of the axis, 2 * axis the lower end.
using Surfaces = std::array<RoomSurface, 6>;

class Room {
 public:
  /// Builds and paints the room, which takes a few tenths of a second. Throws like room_layout(), and like
  /// Ground if the floor is uneven; walls and boxes then extend below the lowest ground.
  Room(const RoomSettings& settings, std::uint64_t seed, const std::optional<Terrain>& terrain = {});

  const RoomLayout& layout() const { return layout_; }
  /// Null if the floor is the plane z = 0; otherwise textured as walls()[4], projected from above.
  const Ground* ground() const { return ground_ ? &*ground_ : nullptr; }
  const Surfaces& walls() const { return walls_; }
  /// Surfaces of layout().boxes[i].
  const Surfaces& box_surfaces(std::size_t i) const { return boxes_[i]; }

 private:
  RoomLayout layout_;
  std::optional<Ground> ground_;
  Surfaces walls_;
  std::vector<Surfaces> boxes_;
};

}  // namespace incognita
