#include "incognita/world/rendered/room.hpp"

#include <optional>

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/surface_texture.hpp"

namespace incognita {
namespace {

constexpr double wall_texel_m = 0.0045, floor_texel_m = 0.006, crate_texel_m = 0.004;
constexpr double max_texels = 2400;  // per side; larger rooms get coarser texels
constexpr std::array<float, 6> wall_light{0.94f, 1.0f, 0.88f, 0.97f, 0.92f, 1.0f};
constexpr std::array<float, 6> crate_light{1.0f, 0.9f, 0.94f, 0.84f, 0.5f, 1.08f};

/// Texels of all surfaces over those of the default room.
double texel_ratio(const RoomSettings& settings) { return settings.texel_m / wall_texel_m; }

double texel_size(const Box& box, double wanted_m, double ratio) {
  return ratio * std::max(wanted_m, (box.max - box.min).maxCoeff() / max_texels);
}

/// Maps a texture onto one side of a box. `mirrored`: its columns run against the axis.
RoomSurface lay(const Canvas& canvas, const Box& box, int axis, bool mirrored, float light) {
  const int across = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
  RoomSurface s;
  s.texture = Texture(canvas.image());
  s.light = light;
  const double u_per_m = s.texture.width() / (box.max[across] - box.min[across]) * (mirrored ? -1 : 1);
  s.u_per_m = static_cast<float>(u_per_m);
  s.u_at_0 = static_cast<float>(-u_per_m * (mirrored ? box.max[across] : box.min[across]) - 0.5);
  const double v_per_m = -s.texture.height() / (box.max[down] - box.min[down]);  // rows go down, the axis up
  s.v_per_m = static_cast<float>(v_per_m);
  s.v_at_0 = static_cast<float>(-v_per_m * box.max[down] - 0.5);
  return s;
}

/// Seen along +x and along -y, the in-plane axis points left, so the texture is mirrored to be read correctly.
bool mirrored(int axis, bool looked_at_along_plus) {
  return axis == 0 ? looked_at_along_plus : axis == 1 && !looked_at_along_plus;
}

/// The sheet on the canvas of the wall at +x: y runs against the columns, z against the rows.
Area sheet_area(const RoomLayout& layout) {
  const Sheet& s = layout.sheet;
  const double left = layout.inside.max.y() - (s.y + s.width / 2);
  const double top = layout.inside.max.z() - (s.z + s.height / 2);
  return {left, top, left + s.width, top + s.height};
}

/// Paints the shadows of the boxes on the floor.
void shade_floor(Canvas& floor, const RoomLayout& layout) {
  const Box& in = layout.inside;
  for (const Box& b : layout.boxes)
    darken_around(
        floor,
        {b.min.x() - in.min.x(), in.max.y() - b.max.y(), b.max.x() - in.min.x(), in.max.y() - b.min.y()},
        0.55, 0.07);
}

Surfaces paint_room(const RoomLayout& layout, double ratio, RandomStream& random) {
  const Box& in = layout.inside;
  const Eigen::Vector3d size = in.max - in.min;
  const double wall_texel = texel_size(in, wall_texel_m, ratio),
               floor_texel = texel_size(in, floor_texel_m, ratio);
  Surfaces out;
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const bool plus = side % 2;
    const std::optional<Area> hangs = side == 1 ? std::optional(sheet_area(layout)) : std::nullopt;
    const Canvas wall = paint_wall(random, size[1 - axis], size.z(), wall_texel, hangs);
    out[side] = lay(wall, in, axis, mirrored(axis, plus), wall_light[side]);
  }
  Canvas floor = paint_floor(random, size.x(), size.y(), floor_texel);
  shade_floor(floor, layout);
  out[4] = lay(floor, in, 2, false, wall_light[4]);
  out[5] = lay(paint_ceiling(random, size.x(), size.y(), floor_texel), in, 2, false, wall_light[5]);
  return out;
}

Surfaces paint_box(const Box& box, double ratio, RandomStream& random) {
  const Eigen::Vector3d size = box.max - box.min;
  const double texel = texel_size(box, crate_texel_m, ratio);
  Surfaces out;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, across = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
    const Canvas crate = paint_crate(random, size[across], size[down], texel);
    out[side] = lay(crate, box, axis, mirrored(axis, side % 2 == 0), crate_light[side]);
  }
  return out;
}

/// Raises each box by the ground height at its center.
void lift_boxes(const Ground& ground, RoomLayout& layout) {
  for (Box& box : layout.boxes) {
    const Eigen::Vector3f middle = (0.5 * (box.min + box.max)).cast<float>();
    const double up_m = ground.at(middle.x(), middle.y()).height;
    box.min.z() += up_m;
    box.max.z() += up_m;
  }
}

/// Extends walls and boxes below the ground, without texture.
void reach_below(const Ground& ground, RoomLayout& layout) {
  constexpr double below_m = 0.05;
  layout.inside.min.z() = ground.lowest_m() - below_m;
  for (Box& box : layout.boxes) box.min.z() = layout.inside.min.z();
}

}  // namespace

Room::Room(const RoomSettings& settings, std::uint64_t seed, const std::optional<Terrain>& terrain)
    : layout_(room_layout(settings, seed)) {
  if (terrain) lift_boxes(ground_.emplace(*terrain, layout_.inside), layout_);
  RandomStream random(seed, "room.paint");
  walls_ = paint_room(layout_, texel_ratio(settings), random);
  for (const Box& box : layout_.boxes) boxes_.push_back(paint_box(box, texel_ratio(settings), random));
  if (ground_) reach_below(*ground_, layout_);
}

}  // namespace incognita
