// Surface textures of the rendered room: corners at all scales, without repetition.
#pragma once

#include <optional>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/canvas.hpp"

namespace incognita {

/// A rectangle on a canvas, m, x right and y down.
struct Area {
  double left = 0, top = 0, right = 0, bottom = 0;

  bool overlaps(const Area& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  Area grown(double margin_m) const {
    return {left - margin_m, top - margin_m, right + margin_m, bottom + margin_m};
  }
};

/// Wall with posters, pages, bookshelves and notes on rough plaster. `keep_free` stays empty.
Canvas paint_wall(RandomStream& random, double width_m, double height_m, double texel_m,
                  const std::optional<Area>& keep_free);
/// Planks of uneven lengths, rugs and scattered objects.
Canvas paint_floor(RandomStream& random, double width_m, double depth_m, double texel_m);
/// Uneven panels with lamps.
Canvas paint_ceiling(RandomStream& random, double width_m, double depth_m, double texel_m);
/// Side of a crate: boards, labels, writing.
Canvas paint_crate(RandomStream& random, double width_m, double height_m, double texel_m);

/// Darkens the edges of a canvas, as where two surfaces meet.
void darken_edges(Canvas& canvas, double share, double reach_m);
/// Shadow around an object that stands or hangs on the surface.
void darken_around(Canvas& canvas, const Area& area, double share, double reach_m);

}  // namespace incognita
