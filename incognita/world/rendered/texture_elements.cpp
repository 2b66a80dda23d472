#include "incognita/world/rendered/texture_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace incognita {
namespace {

/// A random gray level that contrasts with another one.
double contrasting(RandomStream& random, double gray) {
  return gray > 128 ? random.uniform(12, gray - 70) : random.uniform(gray + 70, 245);
}

void draw_triangle(Canvas& canvas, RandomStream& random, const Canvas::Point& center, double radius_m,
                   double gray) {
  const double turn = random.uniform(0, 6.28);
  std::array<Canvas::Point, 3> corners;
  for (int i = 0; i < 3; ++i)
    corners[i] = center + radius_m * Canvas::Point(std::cos(turn + 2.09 * i), std::sin(turn + 2.09 * i));
  canvas.polygon(corners, gray);
}

/// A glyph of 4 x 5 cells, each inked or not.
void draw_sign(Canvas& canvas, RandomStream& random, const TexturePatch& frame, double ink) {
  const double w = frame.width_m / 4, h = frame.height_m / 5;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 4; ++column)
      if (random.uniform() < 0.45) draw_rectangle(canvas, frame.part(column * w, row * h, w, h), ink);
}

}  // namespace

Canvas::Point TexturePatch::at(double x, double y) const {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return origin + Canvas::Point(c * x - s * y, s * x + c * y);
}

TexturePatch TexturePatch::part(double x, double y, double width, double height) const {
  return {at(x, y), angle_rad, width, height};
}

void draw_rectangle(Canvas& canvas, const TexturePatch& f, double gray) {
  const std::array<Canvas::Point, 4> corners{f.at(0, 0), f.at(f.width_m, 0), f.at(f.width_m, f.height_m),
                                             f.at(0, f.height_m)};
  canvas.polygon(corners, gray);
}

void draw_poster(Canvas& canvas, RandomStream& random, const TexturePatch& frame) {
  const double size = std::min(frame.width_m, frame.height_m);
  const double border = random.uniform(0.04, 0.12) * size;
  const bool dark = random.uniform() < 0.35;
  draw_rectangle(canvas, frame, dark ? random.uniform(15, 50) : random.uniform(205, 245));
  const TexturePatch inner =
      frame.part(border, border, frame.width_m - 2 * border, frame.height_m - 2 * border);
  const double kind = random.uniform();
  if (size < 0.09) {
    draw_shapes(canvas, random, inner, random.uniform(20, 235));
  } else if (kind < 0.3) {
    draw_blocks(canvas, random, inner, size > 0.3 ? 6 : 4);
  } else if (kind < 0.55) {
    draw_shapes(canvas, random, inner, random.uniform(20, 235));
  } else if (kind < 0.75) {
    draw_writing(canvas, random, inner, dark ? 225 : 25,
                 std::clamp(size * random.uniform(0.08, 0.2), 0.035, 0.09));
  } else {
    draw_landscape(canvas, random, inner);
  }
}

void draw_blocks(Canvas& canvas, RandomStream& random, const TexturePatch& f, int depth) {
  const bool wide = f.width_m > f.height_m;
  const double longer = std::max(f.width_m, f.height_m);
  if (depth == 0 || longer < 0.05 || (depth < 3 && random.uniform() < 0.25)) {
    draw_rectangle(canvas, f, random.uniform(10, 245));
    return;
  }
  const double cut = longer * random.uniform(0.25, 0.75);
  if (wide) {
    draw_blocks(canvas, random, f.part(0, 0, cut, f.height_m), depth - 1);
    draw_blocks(canvas, random, f.part(cut, 0, f.width_m - cut, f.height_m), depth - 1);
  } else {
    draw_blocks(canvas, random, f.part(0, 0, f.width_m, cut), depth - 1);
    draw_blocks(canvas, random, f.part(0, cut, f.width_m, f.height_m - cut), depth - 1);
  }
}

void draw_shapes(Canvas& canvas, RandomStream& random, const TexturePatch& f, double background) {
  draw_rectangle(canvas, f, background);
  const double size = std::min(f.width_m, f.height_m);
  const int count = 4 + random.below(8);
  for (int i = 0; i < count; ++i) {
    const double radius = std::min(0.45 * size, size * random.uniform(0.08, 0.35));
    const Canvas::Point center =
        f.at(random.uniform(radius, f.width_m - radius), random.uniform(radius, f.height_m - radius));
    const double gray = i % 2 ? random.uniform(10, 245) : contrasting(random, background);
    if (random.uniform() < 0.4) {
      canvas.disc(center, radius, gray);
    } else {
      draw_triangle(canvas, random, center, radius, gray);
    }
  }
}

void draw_writing(Canvas& canvas, RandomStream& random, const TexturePatch& f, double ink, double sign_m) {
  const double sign_width = 0.75 * sign_m;
  for (double y = 0.3 * sign_m; y + sign_m < f.height_m; y += sign_m * random.uniform(1.3, 1.6)) {
    const double end = f.width_m * random.uniform(0.6, 1.0);
    for (double x = 0.2 * sign_m; x + sign_width < end; x += sign_width * 1.25)
      if (random.uniform() > 0.15) draw_sign(canvas, random, f.part(x, y, sign_width, sign_m), ink);
  }
}

void draw_books(Canvas& canvas, RandomStream& random, const TexturePatch& f) {
  draw_rectangle(canvas, f, random.uniform(15, 45));
  for (double x = 0.01; x < f.width_m - 0.03;) {
    const double width = std::min(random.uniform(0.02, 0.065), f.width_m - 0.01 - x);
    const double height = f.height_m * random.uniform(0.6, 0.95);
    const TexturePatch spine = f.part(x, f.height_m - height, width, height);
    const double gray = random.uniform(50, 235);
    draw_rectangle(canvas, spine, gray);
    const double label = height * random.uniform(0.08, 0.3);
    draw_rectangle(canvas, spine.part(0.15 * width, random.uniform(0.05, 0.6) * height, 0.7 * width, label),
                   contrasting(random, gray));
    x += width + random.uniform(0.002, 0.006);
  }
}

void draw_landscape(Canvas& canvas, RandomStream& random, const TexturePatch& f) {
  const double sky = random.uniform(150, 240);
  draw_rectangle(canvas, f, sky);
  const double sun = 0.12 * std::min(f.width_m, f.height_m);
  canvas.disc(f.at(random.uniform(0.2, 0.8) * f.width_m, 0.25 * f.height_m), sun, contrasting(random, sky));
  for (int ridge = 0; ridge < 4; ++ridge) {
    const double base = f.height_m * (0.35 + 0.17 * ridge), gray = random.uniform(15, 170);
    const double lowest = f.height_m;
    double x = 0, y = base + random.uniform(-0.1, 0.1) * f.height_m;
    while (x < f.width_m) {
      const double next_x = std::min(f.width_m, x + random.uniform(0.08, 0.3) * f.width_m);
      const double next_y = base + random.uniform(-0.15, 0.13) * f.height_m;
      const std::array<Canvas::Point, 4> slope{f.at(x, y), f.at(next_x, next_y), f.at(next_x, lowest),
                                               f.at(x, lowest)};
      canvas.polygon(slope, gray);
      x = next_x;
      y = next_y;
    }
  }
}

}  // namespace incognita
