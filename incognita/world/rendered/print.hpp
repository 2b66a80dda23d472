// Printed things for the surfaces of the rendered room: posters, pages of writing, pictures.
#pragma once

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/canvas.hpp"

namespace incognita {

/// A place on a canvas with axes of its own: its origin is the top left corner of what is printed there.
struct Frame {
  Canvas::Point origin{0, 0};  ///< m, on the canvas
  double angle_rad = 0;        ///< clockwise as seen
  double width_m = 0, height_m = 0;

  Canvas::Point at(double x, double y) const;
  /// The part of this frame from (x, y) on.
  Frame part(double x, double y, double width, double height) const;
};

void print_rectangle(Canvas& canvas, const Frame& frame, double grey);

/// One of the things below, on paper with a border.
void print_poster(Canvas& canvas, RandomStream& random, const Frame& frame);

/// An irregular subdivision into rectangles of different greys.
void print_blocks(Canvas& canvas, RandomStream& random, const Frame& frame, int depth);
/// Discs and triangles of every size.
void print_shapes(Canvas& canvas, RandomStream& random, const Frame& frame, double background);
/// Lines of signs, each sign a random pattern.
void print_writing(Canvas& canvas, RandomStream& random, const Frame& frame, double ink, double sign_m);
/// Upright spines of books of different heights.
void print_books(Canvas& canvas, RandomStream& random, const Frame& frame);
/// Ridges of mountains, one before the other.
void print_landscape(Canvas& canvas, RandomStream& random, const Frame& frame);

}  // namespace incognita
