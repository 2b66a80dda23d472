// Printed things for the surfaces of the rendered room: posters, pages of writing, pictures.
#pragma once

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/canvas.hpp"

namespace incognita {

/// A place on a canvas with axes of its own: its origin is the top left corner of what is printed there.
struct TexturePatch {
  Canvas::Point origin{0, 0};  ///< m, on the canvas
  double angle_rad = 0;        ///< clockwise as seen
  double width_m = 0, height_m = 0;

  Canvas::Point at(double x, double y) const;
  /// The part of this frame from (x, y) on.
  TexturePatch part(double x, double y, double width, double height) const;
};

void draw_rectangle(Canvas& canvas, const TexturePatch& frame, double gray);

/// One of the things below, on paper with a border.
void draw_poster(Canvas& canvas, RandomStream& random, const TexturePatch& frame);

/// An irregular subdivision into rectangles of different greys.
void draw_blocks(Canvas& canvas, RandomStream& random, const TexturePatch& frame, int depth);
/// Discs and triangles of every size.
void draw_shapes(Canvas& canvas, RandomStream& random, const TexturePatch& frame, double background);
/// Lines of signs, each sign a random pattern.
void draw_writing(Canvas& canvas, RandomStream& random, const TexturePatch& frame, double ink, double sign_m);
/// Upright spines of books of different heights.
void draw_books(Canvas& canvas, RandomStream& random, const TexturePatch& frame);
/// Ridges of mountains, one before the other.
void draw_landscape(Canvas& canvas, RandomStream& random, const TexturePatch& frame);

}  // namespace incognita
