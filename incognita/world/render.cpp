#include "incognita/world/render.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

using Ray = RayTable::Ray;
using Direction = std::array<float, 3>;  ///< world axes, of any length
using BoxBits = std::uint32_t;           ///< one bit per box of the room

constexpr int tile_px = RayTable::tile_px;
constexpr std::array<int, 3> across_of{1, 0, 0}, down_of{2, 2, 1};
constexpr float white_grey = 236, black_grey = 14;  // of the sheet
constexpr int sheet_wall = 1;                       // at the upper end of x
constexpr std::uint8_t nothing = 255;               // id where no surface is seen

struct Hit {
  float t = std::numeric_limits<float>::max();  ///< ray parameter
  int surface = 0;                              ///< 2 * axis + side
  int box = -1;                                 ///< -1: the room itself
};

struct Bounds {  ///< a box relative to the camera
  std::array<float, 3> min, max;
};

/// What a pixel covers of a texture, in texels: a square of side `face_on`, drawn out by (du, dv) where the
/// surface is seen at a glancing angle.
struct Covered {
  float u, v, du, dv, face_on;
};

/// What can be seen in a tile.
struct TileView {
  BoxBits boxes = 0;
  int wall = -1;  ///< the only wall seen, if there is only one and no box
};

/// One to four samples along what is covered.
inline int sample(const Texture& texture, const Covered& c) {
  const float stretch = c.du * c.du + c.dv * c.dv;
  if (stretch <= std::max(c.face_on * c.face_on, 0.5f)) return texture.sample(c.u, c.v, c.face_on);
  const int count = stretch <= std::max(9 * c.face_on * c.face_on, 2.0f) ? 2 : 4;
  const float step = 1.0f / static_cast<float>(count);
  const float each = std::max(c.face_on, step * std::sqrt(stretch));
  int sum = 0;
  for (float at = 0.5f * step - 0.5f; at < 0.5f; at += step)
    sum += texture.sample(c.u + at * c.du, c.v + at * c.dv, each);
  return sum / count;
}

inline int lit(int grey, const Surface& surface) {
  return std::min(static_cast<int>(static_cast<float>(grey) * surface.light), 255 * 256);
}

inline std::uint8_t rounded(int grey_256) { return static_cast<std::uint8_t>((grey_256 + 128) >> 8); }

/// Share of a pixel's width, centred at `x`, that lies within +-half.
float share_within(float x, float half, float width) {
  const float low = std::max(x - 0.5f * width, -half), high = std::min(x + 0.5f * width, half);
  return std::max(0.0f, high - low) / width;
}

/// A plane rectangle as rays meet it: everything about one surface that is the same for all rays.
class Plane {
 public:
  Plane(const Surface& surface, int axis, float distance, const Eigen::Vector3d& position)
      : axis_(axis), a_(across_of[axis]), b_(down_of[axis]), distance_(distance) {
    u_per_m_ = surface.u_per_m;
    v_per_m_ = surface.v_per_m;
    u_at_camera_ = surface.u_per_m * static_cast<float>(position[a_]) + surface.u_at_0;
    v_at_camera_ = surface.v_per_m * static_cast<float>(position[b_]) + surface.v_at_0;
  }

  Covered covered(const Direction& d, float footprint) const {
    const float per_d = 1.0f / d[axis_], t = distance_ * per_d, footprint_m = t * footprint;
    const float across = d[a_] * u_per_m_, down = d[b_] * v_per_m_, stretch = footprint_m * per_d;
    return {u_at_camera_ + t * across, v_at_camera_ + t * down, stretch * across, stretch * down,
            footprint_m * std::abs(v_per_m_)};
  }

 private:
  int axis_, a_, b_;
  float distance_;  ///< signed, along the axis
  float u_per_m_, v_per_m_, u_at_camera_, v_at_camera_;
};

/// One picture: everything that is the same for all of its pixels.
class Picture {
 public:
  Picture(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
          const Eigen::Vector4d& world_from_camera);

  void draw(Image& out);

 private:
  Bounds relative(const Box& box) const;
  Direction turned(float x, float y, float z = 1) const {
    return {r_[0] * x + r_[1] * y + r_[2] * z, r_[3] * x + r_[4] * y + r_[5] * z,
            r_[6] * x + r_[7] * y + r_[8] * z};
  }
  float distance_to(const Hit& hit) const;

  TileView view_of(const RayTable::Cone& cone) const;
  BoxBits boxes_near(const Direction& axis, float sin_half_angle) const;
  bool only_wall(int wall, const Direction& axis, float sin_half_angle) const;

  void draw_rays(const Ray* rays, int count, BoxBits boxes, std::uint8_t* pixels, std::uint8_t* ids) const;
  void draw_wall(const Ray* rays, int count, int wall, std::uint8_t* pixels, std::uint8_t* ids) const;
  void smooth_edges(Image& out) const;
  bool on_edge(int u, int v) const;
  int mean_of_four(int u, int v) const;

  int grey(float x, float y, float footprint, BoxBits boxes, std::uint8_t& id) const;
  Hit leave_room(const Direction& d, const Direction& inverse) const;
  void enter_boxes(const Direction& d, const Direction& inverse, BoxBits boxes, Hit& hit) const;
  int with_sheet(int wall, const Direction& d, float footprint) const;

  const Room& room_;
  const RayTable& rays_;
  Eigen::Vector3d position_;
  std::array<float, 9> r_;  ///< world_from_camera, row by row
  Bounds inside_;
  std::vector<Bounds> boxes_;
  std::vector<TileView> tiles_;
  std::vector<std::uint8_t> ids_;  ///< of the surface each pixel sees
};

Picture::Picture(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
                 const Eigen::Vector4d& world_from_camera)
    : room_(room), rays_(rays), position_(position), ids_(rays.rays.size(), nothing) {
  const Eigen::Matrix3d r = rotation_matrix<double>(world_from_camera);
  for (int i = 0; i < 9; ++i) r_[i] = static_cast<float>(r(i / 3, i % 3));
  inside_ = relative(room.layout().inside);
  for (const Box& box : room.layout().boxes) boxes_.push_back(relative(box));
  tiles_.reserve(rays.cones.size());
  for (const RayTable::Cone& cone : rays.cones) tiles_.push_back(view_of(cone));
}

Bounds Picture::relative(const Box& box) const {
  Bounds b;
  for (int i = 0; i < 3; ++i) {
    b.min[i] = static_cast<float>(box.min[i] - position_[i]);
    b.max[i] = static_cast<float>(box.max[i] - position_[i]);
  }
  return b;
}

TileView Picture::view_of(const RayTable::Cone& cone) const {
  const Direction axis = turned(cone.axis.x(), cone.axis.y(), cone.axis.z());
  TileView view;
  view.boxes = boxes_near(axis, cone.sin_half_angle);
  const int wall = leave_room(axis, {1 / axis[0], 1 / axis[1], 1 / axis[2]}).surface;
  if (!view.boxes && only_wall(wall, axis, cone.sin_half_angle)) view.wall = wall;
  return view;
}

/// A ray in the cone that meets a box passes it no farther from the axis than the box's far end times the
/// sine of the half angle: the axis then meets the box grown by as much.
BoxBits Picture::boxes_near(const Direction& axis, float sin_half_angle) const {
  BoxBits bits = 0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Bounds& b = boxes_[i];
    float reach_squared = 0, enter = 0, leave = std::numeric_limits<float>::max();
    for (int k = 0; k < 3; ++k) reach_squared += std::max(b.min[k] * b.min[k], b.max[k] * b.max[k]);
    const float margin = std::sqrt(reach_squared) * sin_half_angle;
    for (int k = 0; k < 3; ++k) {
      const float low = (b.min[k] - margin) / axis[k], high = (b.max[k] + margin) / axis[k];
      enter = std::max(enter, std::min(low, high));
      leave = std::min(leave, std::max(low, high));
    }
    if (enter <= leave || sin_half_angle >= 1) bits |= BoxBits{1} << i;
  }
  return bits;
}

/// Whether a cone lies between the four planes through the camera and the edges of a wall.
bool Picture::only_wall(int wall, const Direction& axis, float sin_half_angle) const {
  const int k = wall / 2;
  const float to_wall = 1.0f / (wall % 2 ? inside_.max[k] : inside_.min[k]);
  for (const int i : {across_of[k], down_of[k]})
    for (const float to_next : {1.0f / inside_.min[i], 1.0f / inside_.max[i]}) {
      const float length = std::sqrt(to_wall * to_wall + to_next * to_next);
      if (!(axis[k] * to_wall - axis[i] * to_next > sin_half_angle * length)) return false;
    }
  return true;
}

void Picture::draw(Image& out) {
  for (int v = 0; v < rays_.height; ++v)
    for (int tile = 0; tile < rays_.tiles_across; ++tile) {
      const TileView& view = tiles_[v / tile_px * rays_.tiles_across + tile];
      const int u = tile * tile_px, count = std::min(tile_px, rays_.width - u);
      std::uint8_t* ids = &ids_[static_cast<std::size_t>(v) * rays_.width + u];
      if (view.wall >= 0)
        draw_wall(&rays_.at(u, v), count, view.wall, out.row(v) + u, ids);
      else
        draw_rays(&rays_.at(u, v), count, view.boxes, out.row(v) + u, ids);
    }
  smooth_edges(out);
}

void Picture::draw_rays(const Ray* rays, int count, BoxBits boxes, std::uint8_t* pixels,
                        std::uint8_t* ids) const {
  for (int i = 0; i < count; ++i)
    pixels[i] =
        rays[i].footprint > 0 ? rounded(grey(rays[i].x, rays[i].y, rays[i].footprint, boxes, ids[i])) : 0;
}

/// Where only one wall can be seen there is nothing to choose.
void Picture::draw_wall(const Ray* rays, int count, int wall, std::uint8_t* pixels, std::uint8_t* ids) const {
  const Surface& surface = room_.walls()[wall];
  const Plane plane(surface, wall / 2, distance_to({0, wall, -1}), position_);
  for (int i = 0; i < count; ++i) {
    pixels[i] = 0;
    if (!(rays[i].footprint > 0)) continue;
    const Direction d = turned(rays[i].x, rays[i].y);
    int grey = sample(surface.texture, plane.covered(d, rays[i].footprint));
    if (wall == sheet_wall) grey = with_sheet(grey, d, rays[i].footprint);
    pixels[i] = rounded(lit(grey, surface));
    ids[i] = static_cast<std::uint8_t>(wall);
  }
}

/// Textures come smooth from their pyramids; only where two surfaces meet do steps appear. There, and there
/// alone, four rays are cast for a pixel.
void Picture::smooth_edges(Image& out) const {
  for (int v = 1; v < rays_.height - 1; ++v)
    for (int u = 1; u < rays_.width - 1; ++u)
      if (on_edge(u, v)) out(u, v) = rounded(mean_of_four(u, v));
}

bool Picture::on_edge(int u, int v) const {
  const std::uint8_t* id = &ids_[static_cast<std::size_t>(v) * rays_.width + u];
  const std::array<std::uint8_t, 4> around{id[1], id[-1], id[rays_.width], id[-rays_.width]};
  const bool same = id[0] == around[0] && id[0] == around[1] && id[0] == around[2] && id[0] == around[3];
  return !same && id[0] != nothing && std::find(around.begin(), around.end(), nothing) == around.end();
}

int Picture::mean_of_four(int u, int v) const {
  const Ray& ray = rays_.at(u, v);
  const Ray &left = rays_.at(u - 1, v), &right = rays_.at(u + 1, v);
  const Ray &above = rays_.at(u, v - 1), &below = rays_.at(u, v + 1);
  const float xu = 0.125f * (right.x - left.x), yu = 0.125f * (right.y - left.y);  // a quarter pixel
  const float xv = 0.125f * (below.x - above.x), yv = 0.125f * (below.y - above.y);
  const BoxBits boxes = tiles_[v / tile_px * rays_.tiles_across + u / tile_px].boxes;
  std::uint8_t id = 0;
  int sum = 0;
  for (const auto& [du, dv] : {std::pair(-1.f, -1.f), {1.f, -1.f}, {-1.f, 1.f}, {1.f, 1.f}})
    sum += grey(ray.x + du * xu + dv * xv, ray.y + du * yu + dv * yv, 0.6f * ray.footprint, boxes, id);
  return sum / 4;
}

/// 256 times the grey that a ray sees, and the id of the surface that it meets.
inline int Picture::grey(float x, float y, float footprint, BoxBits boxes, std::uint8_t& id) const {
  const Direction d = turned(x, y), inverse{1.0f / d[0], 1.0f / d[1], 1.0f / d[2]};
  Hit hit = leave_room(d, inverse);
  if (boxes) enter_boxes(d, inverse, boxes, hit);
  id = static_cast<std::uint8_t>((hit.box + 1) * 6 + hit.surface);
  const Surface& surface = (hit.box < 0 ? room_.walls() : room_.box_surfaces(hit.box))[hit.surface];
  const Plane plane(surface, hit.surface / 2, distance_to(hit), position_);
  const int seen = sample(surface.texture, plane.covered(d, footprint));
  return lit(hit.box < 0 && hit.surface == sheet_wall ? with_sheet(seen, d, footprint) : seen, surface);
}

float Picture::distance_to(const Hit& hit) const {
  const Bounds& b = hit.box < 0 ? inside_ : boxes_[hit.box];
  return hit.surface % 2 ? b.max[hit.surface / 2] : b.min[hit.surface / 2];
}

inline Hit Picture::leave_room(const Direction& d, const Direction& inverse) const {
  Hit hit;
  for (int i = 0; i < 3; ++i) {
    const int side = d[i] > 0;
    const float t = (side ? inside_.max[i] : inside_.min[i]) * inverse[i];
    if (t < hit.t) hit = {t, 2 * i + side, -1};
  }
  return hit;
}

/// Of the boxes a ray enters before what it has hit so far, the nearest.
void Picture::enter_boxes(const Direction& d, const Direction& inverse, BoxBits boxes, Hit& hit) const {
  for (; boxes; boxes &= boxes - 1) {
    const int box = std::countr_zero(boxes);
    const Bounds& b = boxes_[box];
    float enter = 0, leave = hit.t;
    int surface = -1;
    for (int i = 0; i < 3; ++i) {
      const bool up = d[i] > 0;
      const float first = (up ? b.min[i] : b.max[i]) * inverse[i],
                  last = (up ? b.max[i] : b.min[i]) * inverse[i];
      if (first > enter) {
        enter = first;
        surface = 2 * i + !up;
      }
      leave = std::min(leave, last);
    }
    if (surface >= 0 && enter < leave) hit = {enter, surface, box};
  }
}

/// The sheet is not a texture but worked out exactly, so that its corners are as sharp as the camera can see
/// them.
inline int Picture::with_sheet(int wall, const Direction& d, float footprint) const {
  const Sheet& s = room_.layout().sheet;
  const float per_d = 1.0f / d[0], t = inside_.max[0] * per_d, footprint_m = t * footprint;
  const float y = static_cast<float>(position_.y() - s.y) + t * d[1];
  const float z = static_cast<float>(position_.z() - s.z) + t * d[2];
  const float half_width = static_cast<float>(s.width / 2), half_height = static_cast<float>(s.height / 2);
  const float ty = d[1] * per_d, tz = d[2] * per_d;
  const float width = footprint_m * std::sqrt(1 + ty * ty), height = footprint_m * std::sqrt(1 + tz * tz);
  if (std::abs(y) > half_width + width || std::abs(z) > half_height + height) return wall;
  const float paper = share_within(y, half_width, width) * share_within(z, half_height, height);
  const float ink = share_within(y, static_cast<float>(s.black_width / 2), width) *
                    share_within(z, static_cast<float>(s.black_height / 2), height);
  const float sheet = white_grey + ink * (black_grey - white_grey);
  return static_cast<int>(static_cast<float>(wall) * (1 - paper) + 256 * sheet * paper);
}

}  // namespace

void render(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
            const Eigen::Vector4d& world_from_camera, Image& out) {
  if (out.width() != rays.width || out.height() != rays.height) out = Image(rays.width, rays.height);
  if (!room.layout().inside.contains(position)) {
    out = Image(rays.width, rays.height);
    return;
  }
  Picture(room, rays, position, world_from_camera).draw(out);
}

}  // namespace incognita
