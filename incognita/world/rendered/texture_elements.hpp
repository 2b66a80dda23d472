// Texture elements of the rendered room: posters, pages of writing, pictures.
#pragma once

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/canvas.hpp"

namespace incognita {

/// Local frame on a canvas; its origin is the top left corner of the element.
struct TexturePatch {
  Canvas::Point origin{0, 0};  ///< m, on the canvas
  double angle_rad = 0;        ///< clockwise as seen
  double width_m = 0, height_m = 0;

  Canvas::Point at(double x, double y) const;
  /// Sub-rectangle of this patch with its corner at (x, y).
  TexturePatch part(double x, double y, double width, double height) const;
};

void draw_rectangle(Canvas& canvas, const TexturePatch& frame, double gray);

/// A random one of the elements below, on paper with a border.
void draw_poster(Canvas& canvas, RandomStream& random, const TexturePatch& frame);

/// Recursive subdivision into rectangles of random gray levels.
void draw_blocks(Canvas& canvas, RandomStream& random, const TexturePatch& frame, int depth);
/// Discs and triangles of random sizes.
void draw_shapes(Canvas& canvas, RandomStream& random, const TexturePatch& frame, double background);
/// Lines of random glyphs.
void draw_writing(Canvas& canvas, RandomStream& random, const TexturePatch& frame, double ink, double sign_m);
/// Upright book spines of different heights.
void draw_books(Canvas& canvas, RandomStream& random, const TexturePatch& frame);
/// Overlapping mountain ridges.
void draw_landscape(Canvas& canvas, RandomStream& random, const TexturePatch& frame);

}  // namespace incognita
