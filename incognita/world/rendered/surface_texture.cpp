#include "incognita/world/rendered/surface_texture.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/world/rendered/texture_elements.hpp"

namespace incognita {
namespace {

/// Roughness at all scales that a camera in the room can resolve.
void add_grain(Canvas& canvas, RandomStream& random, double strength) {
  canvas.add_noise(random, 0.9, 1.2 * strength);
  canvas.add_noise(random, 0.31, strength);
  canvas.add_noise(random, 0.097, strength);
  canvas.add_noise(random, 0.037, 0.8 * strength);
  canvas.add_noise(random, 0.013, 0.6 * strength);
}

/// Places elements at random without overlap.
class NonOverlappingPlacer {
 public:
  NonOverlappingPlacer(Canvas& canvas, RandomStream& random) : canvas_(canvas), random_(random) {}

  void keep_free(const Area& area) { taken_.push_back(area); }

  template <class DrawElement>
  void scatter(int tries, double low_m, double high_m, double bottom_m, DrawElement draw) {
    for (int i = 0; i < tries; ++i) {
      const double w = random_.uniform(low_m, high_m), h = w * random_.uniform(0.6, 1.5);
      const double room_x = canvas_.width_m() - w - 0.06, room_y = canvas_.height_m() - bottom_m - h - 0.06;
      if (room_x <= 0 || room_y <= 0) continue;
      const double x = 0.03 + random_.uniform() * room_x, y = 0.03 + random_.uniform() * room_y;
      const Area area{x, y, x + w, y + h};
      const auto meets = [&](const Area& other) { return area.grown(0.02 + 0.06 * w).overlaps(other); };
      if (std::any_of(taken_.begin(), taken_.end(), meets)) continue;
      taken_.push_back(area);
      draw(TexturePatch{{x, y}, 0, w, h});
    }
  }

  void scatter_posters(int tries, double low_m, double high_m, double bottom_m, double tilt_rad) {
    scatter(tries, low_m, high_m, bottom_m, [&](TexturePatch frame) {
      shadow(frame);
      frame.angle_rad = random_.uniform(-tilt_rad, tilt_rad);
      draw_poster(canvas_, random_, frame);
    });
  }

  /// Thin elements on a wall cast a thin shadow.
  void shadow(const TexturePatch& f) {
    const Area area{f.origin.x(), f.origin.y(), f.origin.x() + f.width_m, f.origin.y() + f.height_m};
    darken_around(canvas_, area, 0.35, 0.015);
  }

 private:
  Canvas& canvas_;
  RandomStream& random_;
  std::vector<Area> taken_;
};

/// Number of tries that gives the same density for every area.
int tries_for(const Canvas& canvas, double per_square_meter) {
  return static_cast<int>(per_square_meter * canvas.width_m() * canvas.height_m());
}

/// Boards of uneven width and length along x.
void paint_boards(Canvas& canvas, RandomStream& random, double width_low_m, double width_high_m,
                  double gray_low, double gray_high) {
  for (double y = 0; y < canvas.height_m();) {
    const double width = random.uniform(width_low_m, width_high_m);
    for (double x = -random.uniform(0, 0.8); x < canvas.width_m();) {
      const double length = random.uniform(0.4, 1.6);
      draw_rectangle(canvas, {{x, y}, 0, length - 0.007, width - 0.007}, random.uniform(gray_low, gray_high));
      x += length;
    }
    y += width;
  }
}

/// Shelves of books, one above the other.
void draw_shelf(Canvas& canvas, RandomStream& random, const TexturePatch& shelf) {
  const int boards = std::max(1, static_cast<int>(shelf.height_m / 0.3));
  const double height = shelf.height_m / boards;
  for (int i = 0; i < boards; ++i) {
    const TexturePatch board = shelf.part(0, i * height, shelf.width_m, height);
    draw_books(canvas, random, board.part(0, 0, board.width_m, height - 0.025));
    draw_rectangle(canvas, board.part(0, height - 0.025, board.width_m, 0.025), random.uniform(150, 200));
  }
}

double distance_outside(const Area& a, double x, double y) {
  const double dx = std::max({a.left - x, 0.0, x - a.right}), dy = std::max({a.top - y, 0.0, y - a.bottom});
  return std::hypot(dx, dy);
}

}  // namespace

Canvas paint_wall(RandomStream& random, double width_m, double height_m, double texel_m,
                  const std::optional<Area>& keep_free) {
  Canvas canvas(width_m, height_m, texel_m, random.uniform(125, 170));
  add_grain(canvas, random, 13);
  NonOverlappingPlacer placer(canvas, random);
  if (keep_free) {
    darken_around(canvas, *keep_free, 0.4, 0.02);
    placer.keep_free(keep_free->grown(0.03));
  }
  const double skirting_m = 0.11;
  placer.scatter(tries_for(canvas, 0.3), 0.5, 1.0, skirting_m, [&](const TexturePatch& shelf) {
    placer.shadow(shelf);
    draw_shelf(canvas, random, shelf);
  });
  placer.scatter_posters(tries_for(canvas, 3), 0.35, 0.7, skirting_m, 0);
  placer.scatter_posters(tries_for(canvas, 12), 0.16, 0.34, skirting_m, 0.03);
  placer.scatter_posters(tries_for(canvas, 45), 0.06, 0.14, skirting_m, 0.2);
  for (double x = 0; x < width_m;) {
    const double length = random.uniform(0.3, 1.1);
    draw_rectangle(canvas, {{x, height_m - skirting_m}, 0, length - 0.006, skirting_m},
                   random.uniform(45, 95));
    x += length;
  }
  canvas.add_noise(random, 0.016, 9);
  darken_edges(canvas, 0.35, 0.22);
  return canvas;
}

Canvas paint_floor(RandomStream& random, double width_m, double depth_m, double texel_m) {
  Canvas canvas(width_m, depth_m, texel_m, 38);
  paint_boards(canvas, random, 0.09, 0.2, 85, 165);
  add_grain(canvas, random, 11);
  NonOverlappingPlacer lying(canvas, random);
  lying.scatter(tries_for(canvas, 0.15), 1.0, 1.6, 0, [&](TexturePatch rug) {
    draw_rectangle(canvas, rug, random.uniform(30, 60));
    draw_blocks(canvas, random, rug.part(0.06, 0.06, rug.width_m - 0.12, rug.height_m - 0.12), 7);
  });
  lying.scatter_posters(tries_for(canvas, 4), 0.1, 0.3, 0, 1.0);
  canvas.add_noise(random, 0.021, 10);
  darken_edges(canvas, 0.4, 0.25);
  return canvas;
}

Canvas paint_ceiling(RandomStream& random, double width_m, double depth_m, double texel_m) {
  Canvas canvas(width_m, depth_m, texel_m, 120);
  paint_boards(canvas, random, 0.3, 0.8, 165, 215);
  add_grain(canvas, random, 10);
  NonOverlappingPlacer lamps(canvas, random);
  lamps.scatter(tries_for(canvas, 1.2), 0.15, 0.4, 0, [&](const TexturePatch& lamp) {
    const double radius = 0.5 * std::min(lamp.width_m, lamp.height_m);
    canvas.disc(lamp.at(lamp.width_m / 2, lamp.height_m / 2), radius, random.uniform(40, 90));
    canvas.disc(lamp.at(lamp.width_m / 2, lamp.height_m / 2), 0.7 * radius, random.uniform(235, 255));
  });
  lamps.scatter(tries_for(canvas, 4), 0.08, 0.25, 0,
                [&](const TexturePatch& vent) { draw_blocks(canvas, random, vent, 3); });
  canvas.add_noise(random, 0.023, 8);
  darken_edges(canvas, 0.3, 0.3);
  return canvas;
}

Canvas paint_crate(RandomStream& random, double width_m, double height_m, double texel_m) {
  Canvas canvas(width_m, height_m, texel_m, 35);
  const double base = random.uniform(90, 190);
  paint_boards(canvas, random, 0.07, 0.16, base - 30, base + 30);
  add_grain(canvas, random, 9);
  NonOverlappingPlacer labels(canvas, random);
  labels.scatter_posters(tries_for(canvas, 12) + 4, 0.18, 0.32, 0, 0.08);
  labels.scatter_posters(tries_for(canvas, 40) + 6, 0.06, 0.14, 0, 0.25);
  canvas.add_noise(random, 0.015, 8);
  darken_edges(canvas, 0.25, 0.05);
  return canvas;
}

void darken_edges(Canvas& canvas, double share, double reach_m) {
  const double w = canvas.width_m(), h = canvas.height_m();
  const auto dark =
      [=](double distance_m) {  // cubic falloff with bounded reach: avoids an exponential per texel
        const double near = std::max(0.0, 1 - distance_m / (3 * reach_m));
        return 1 - share * near * near * near;
      };
  canvas.light({0, 0}, {w, h},
               [=](double x, double y) { return dark(std::min(x, w - x)) * dark(std::min(y, h - y)); });
}

void darken_around(Canvas& canvas, const Area& area, double share, double reach_m) {
  const Area around = area.grown(4 * reach_m);
  canvas.light({around.left, around.top}, {around.right, around.bottom}, [=](double x, double y) {
    return 1 - share * std::exp(-distance_outside(area, x, y) / reach_m);
  });
}

}  // namespace incognita
