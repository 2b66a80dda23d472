// What is painted on the surfaces of the rendered room: rich in corners of every size, and never twice the
// same.
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

/// A wall with posters, pages, shelves of books and notes on rough plaster. Nothing hangs on `keep_free`.
Canvas paint_wall(RandomStream& random, double width_m, double height_m, double texel_m,
                  const std::optional<Area>& keep_free);
/// Planks of uneven lengths, rugs and things that lie about.
Canvas paint_floor(RandomStream& random, double width_m, double depth_m, double texel_m);
/// Uneven panels with lamps.
Canvas paint_ceiling(RandomStream& random, double width_m, double depth_m, double texel_m);
/// A crate's side: boards, labels, writing.
Canvas paint_crate(RandomStream& random, double width_m, double height_m, double texel_m);

/// Where two surfaces meet less light comes: darkens towards the edges of a canvas.
void darken_edges(Canvas& canvas, double share, double reach_m);
/// The shadow that something standing or hanging there throws around itself.
void darken_around(Canvas& canvas, const Area& area, double share, double reach_m);

}  // namespace incognita
