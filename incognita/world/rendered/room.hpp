// The rendered room as data: where things stand and what they look like.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/world/rendered/ground.hpp"
#include "incognita/world/rendered/room_layout.hpp"
#include "incognita/world/rendered/texture.hpp"

namespace incognita {

/// One axis-aligned flat surface. The texture is laid on it so that it reads the right way round from the
/// front.
struct Surface {
  Texture texture;
  /// Texels of a point: u = u_per_m * P[a] + u_at_0 and v likewise of P[b], where a, b are the two axes of
  /// the surface in rising order.
  float u_per_m = 1, u_at_0 = 0, v_per_m = 1, v_at_0 = 0;
  float light = 1;  ///< share of the light that reaches this side
};

/// Six surfaces of a box, at [2 * axis + 1] the one at the upper end of that axis and at [2 * axis] the
/// other.
using Surfaces = std::array<Surface, 6>;

class Room {
 public:
  /// Builds and paints the room; takes a few tenths of a second. Throws like room_layout(), and like Ground
  /// where its floor is uneven: walls and boxes then go down below its lowest place.
  Room(const RoomSettings& settings, std::uint64_t seed, const std::optional<Terrain>& terrain = {});

  const RoomLayout& layout() const { return layout_; }
  /// Null where the floor is the plane z = 0; else painted as walls()[4] is, seen from above.
  const Ground* ground() const { return ground_ ? &*ground_ : nullptr; }
  const Surfaces& walls() const { return walls_; }
  /// Of layout().boxes[i].
  const Surfaces& box_surfaces(std::size_t i) const { return boxes_[i]; }

 private:
  RoomLayout layout_;
  std::optional<Ground> ground_;
  Surfaces walls_;
  std::vector<Surfaces> boxes_;
};

}  // namespace incognita
