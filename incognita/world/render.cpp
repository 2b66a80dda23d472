#include "incognita/world/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

using Ray = RayTable::Ray;
using BoxBits = std::uint32_t;  ///< one bit per box of the room

constexpr std::array<int, 3> across_of{1, 0, 0}, down_of{2, 2, 1};
constexpr float white_grey = 236, black_grey = 14;  // of the sheet
constexpr std::uint8_t nothing = 255;               // id where no surface is seen

struct Hit {
  float t = std::numeric_limits<float>::max();  ///< ray parameter
  int axis = 0, side = 0;                       ///< the surface is at [2 * axis + side]
  int box = -1;                                 ///< -1: the room itself
};

struct Bounds {  ///< a box relative to the camera
  std::array<float, 3> min, max;
};

/// One picture: everything that is the same for all of its pixels.
class Picture {
 public:
  Picture(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
          const Eigen::Vector4d& world_from_camera);

  void draw(Image& out);

 private:
  Bounds relative(const Box& box) const;
  BoxBits boxes_seen(const RayTable::Cone& cone) const;
  std::array<float, 3> turned(float x, float y) const {
    return {r_[0] * x + r_[1] * y + r_[2], r_[3] * x + r_[4] * y + r_[5], r_[6] * x + r_[7] * y + r_[8]};
  }

  void draw_tile(int tile, Image& out);
  void smooth_edges(Image& out) const;
  bool on_edge(int u, int v) const;
  int mean_of_four(int u, int v) const;

  /// 256 times the grey that a ray sees, and the id of the surface that it meets.
  int grey(float x, float y, float footprint, BoxBits boxes, std::uint8_t& id) const;
  Hit meet(const std::array<float, 3>& d, BoxBits boxes) const;
  int grey_at(const Hit& hit, const std::array<float, 3>& d, float footprint) const;
  int with_sheet(int wall, const std::array<float, 3>& d, const Hit& hit, float footprint) const;

  const Room& room_;
  const RayTable& rays_;
  Eigen::Vector3d position_;
  std::array<float, 9> r_;  ///< world_from_camera, row by row
  Bounds inside_;
  std::vector<Bounds> boxes_;
  std::vector<BoxBits> seen_;      ///< by each tile
  std::vector<std::uint8_t> ids_;  ///< of the surface each pixel sees
};

Picture::Picture(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
                 const Eigen::Vector4d& world_from_camera)
    : room_(room), rays_(rays), position_(position), ids_(rays.rays.size(), nothing) {
  const Eigen::Matrix3d r = rotation_matrix<double>(world_from_camera);
  for (int i = 0; i < 9; ++i) r_[i] = static_cast<float>(r(i / 3, i % 3));
  inside_ = relative(room.layout().inside);
  for (const Box& box : room.layout().boxes) boxes_.push_back(relative(box));
  for (const RayTable::Cone& cone : rays.cones) seen_.push_back(boxes_seen(cone));
}

Bounds Picture::relative(const Box& box) const {
  Bounds b;
  for (int i = 0; i < 3; ++i) {
    b.min[i] = static_cast<float>(box.min[i] - position_[i]);
    b.max[i] = static_cast<float>(box.max[i] - position_[i]);
  }
  return b;
}

/// A box can only be seen in a tile when the cone meets the ball around the box.
BoxBits Picture::boxes_seen(const RayTable::Cone& cone) const {
  const auto axis = Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(r_.data()) * cone.axis;
  BoxBits bits = 0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Eigen::Vector3f low(boxes_[i].min.data()), high(boxes_[i].max.data());
    const Eigen::Vector3f centre = 0.5f * (low + high);
    const float distance = centre.norm(), radius = 0.5f * (high - low).norm();
    const float wide = distance > radius ? cone.half_angle_rad + std::asin(radius / distance) : 4.0f;
    if (wide >= 3.1f || axis.dot(centre) >= distance * std::cos(wide)) bits |= BoxBits{1} << i;
  }
  return bits;
}

void Picture::draw(Image& out) {
  const int tiles = rays_.tiles_across * rays_.tiles_down;
  for (int tile = 0; tile < tiles; ++tile) draw_tile(tile, out);
  smooth_edges(out);
}

void Picture::draw_tile(int tile, Image& out) {
  const int u0 = tile % rays_.tiles_across * RayTable::tile_px,
            v0 = tile / rays_.tiles_across * RayTable::tile_px;
  const int u1 = std::min(u0 + RayTable::tile_px, rays_.width);
  const int v1 = std::min(v0 + RayTable::tile_px, rays_.height);
  for (int v = v0; v < v1; ++v) {
    const Ray* ray = &rays_.at(0, v);
    std::uint8_t* pixel = out.row(v);
    std::uint8_t* id = &ids_[static_cast<std::size_t>(v) * rays_.width];
    for (int u = u0; u < u1; ++u)
      pixel[u] = ray[u].footprint > 0
                     ? static_cast<std::uint8_t>(
                           (grey(ray[u].x, ray[u].y, ray[u].footprint, seen_[tile], id[u]) + 128) >> 8)
                     : 0;
  }
}

/// Textures come smooth from their pyramids; only where two surfaces meet do steps appear. There, and there
/// alone, four rays are cast for a pixel.
void Picture::smooth_edges(Image& out) const {
  for (int v = 1; v < rays_.height - 1; ++v)
    for (int u = 1; u < rays_.width - 1; ++u)
      if (on_edge(u, v)) out(u, v) = static_cast<std::uint8_t>((mean_of_four(u, v) + 128) >> 8);
}

bool Picture::on_edge(int u, int v) const {
  const std::uint8_t* id = &ids_[static_cast<std::size_t>(v) * rays_.width + u];
  return (id[0] != id[1] || id[0] != id[-1] || id[0] != id[rays_.width] || id[0] != id[-rays_.width]) &&
         id[0] != nothing && id[1] != nothing && id[-1] != nothing && id[rays_.width] != nothing &&
         id[-rays_.width] != nothing;
}

int Picture::mean_of_four(int u, int v) const {
  const Ray& ray = rays_.at(u, v);
  const Ray &left = rays_.at(u - 1, v), &right = rays_.at(u + 1, v);
  const Ray &above = rays_.at(u, v - 1), &below = rays_.at(u, v + 1);
  const float xu = 0.125f * (right.x - left.x), yu = 0.125f * (right.y - left.y);  // a quarter pixel
  const float xv = 0.125f * (below.x - above.x), yv = 0.125f * (below.y - above.y);
  const BoxBits boxes = seen_[v / RayTable::tile_px * rays_.tiles_across + u / RayTable::tile_px];
  std::uint8_t id = 0;
  int sum = 0;
  for (const auto& [du, dv] : {std::pair(-1.f, -1.f), {1.f, -1.f}, {-1.f, 1.f}, {1.f, 1.f}})
    sum += grey(ray.x + du * xu + dv * xv, ray.y + du * yu + dv * yv, 0.6f * ray.footprint, boxes, id);
  return sum / 4;
}

inline int Picture::grey(float x, float y, float footprint, BoxBits boxes, std::uint8_t& id) const {
  const std::array<float, 3> d = turned(x, y);
  const Hit hit = meet(d, boxes);
  if (!(hit.t > 0)) return 0;
  id = static_cast<std::uint8_t>((hit.box + 1) * 6 + 2 * hit.axis + hit.side);
  return grey_at(hit, d, hit.t * footprint);
}

/// Where a ray leaves the room, unless it enters a box before.
inline Hit Picture::meet(const std::array<float, 3>& d, BoxBits boxes) const {
  Hit hit;
  std::array<float, 3> inverse;
  for (int i = 0; i < 3; ++i) {
    inverse[i] = 1.0f / d[i];
    const int side = d[i] > 0;
    const float t = (side ? inside_.max[i] : inside_.min[i]) * inverse[i];
    if (t < hit.t) hit = {t, i, side, -1};
  }
  for (; boxes; boxes &= boxes - 1) {
    const int box = std::countr_zero(boxes);
    const Bounds& b = boxes_[box];
    float enter = 0, leave = hit.t;
    int axis = -1;
    for (int i = 0; i < 3; ++i) {
      const bool up = d[i] > 0;
      const float first = (up ? b.min[i] : b.max[i]) * inverse[i],
                  last = (up ? b.max[i] : b.min[i]) * inverse[i];
      if (first > enter) {
        enter = first;
        axis = i;
      }
      leave = std::min(leave, last);
    }
    if (axis >= 0 && enter < leave) hit = {enter, axis, d[axis] < 0, box};
  }
  return hit;
}

/// A pixel covers a long stretch of a surface seen at a glancing angle: one to four samples lie along it.
inline int Picture::grey_at(const Hit& hit, const std::array<float, 3>& d, float footprint_m) const {
  const Surfaces& surfaces = hit.box < 0 ? room_.walls() : room_.box_surfaces(hit.box);
  const Surface& s = surfaces[2 * hit.axis + hit.side];
  const int a = across_of[hit.axis], b = down_of[hit.axis];
  const float x = static_cast<float>(position_[a]) + hit.t * d[a];
  const float y = static_cast<float>(position_[b]) + hit.t * d[b];
  const float u = s.u_per_m * x + s.u_at_0, v = s.v_per_m * y + s.v_at_0;
  const float per_m = std::abs(s.v_per_m);
  const float stretch = footprint_m / std::abs(d[hit.axis]);
  const float du = stretch * d[a] * s.u_per_m, dv = stretch * d[b] * s.v_per_m;  // along the stretch, texels
  const float face_on = footprint_m * per_m, squared = du * du + dv * dv;
  int grey = 0;
  if (squared <= std::max(0.5f * face_on * face_on, 0.25f)) {
    grey = s.texture.sample(u, v, face_on);
  } else if (squared <= std::max(4 * face_on * face_on, 1.0f)) {
    const float each = std::max(face_on, 0.5f * std::sqrt(squared));
    grey = (s.texture.sample(u - 0.25f * du, v - 0.25f * dv, each) +
            s.texture.sample(u + 0.25f * du, v + 0.25f * dv, each)) /
           2;
  } else {
    const float each = std::max(face_on, 0.25f * std::sqrt(squared));
    for (const float k : {-0.375f, -0.125f, 0.125f, 0.375f})
      grey += s.texture.sample(u + k * du, v + k * dv, each);
    grey /= 4;
  }
  if (hit.box < 0 && hit.axis == 0 && hit.side == 1) grey = with_sheet(grey, d, hit, footprint_m);
  return std::min(static_cast<int>(static_cast<float>(grey) * s.light), 255 * 256);
}

/// Share of a pixel's width, centred at `x`, that lies within +-half.
float share_within(float x, float half, float width) {
  const float low = std::max(x - 0.5f * width, -half), high = std::min(x + 0.5f * width, half);
  return std::max(0.0f, high - low) / width;
}

/// The sheet is not a texture but worked out exactly, so that its corners are as sharp as the camera can see
/// them.
int Picture::with_sheet(int wall, const std::array<float, 3>& d, const Hit& hit, float footprint_m) const {
  const Sheet& s = room_.layout().sheet;
  const float y = static_cast<float>(position_.y() - s.y) + hit.t * d[1];
  const float z = static_cast<float>(position_.z() - s.z) + hit.t * d[2];
  const float half_width = static_cast<float>(s.width / 2), half_height = static_cast<float>(s.height / 2);
  if (std::abs(y) > half_width + 4 * footprint_m || std::abs(z) > half_height + 4 * footprint_m) return wall;
  const float ty = d[1] / d[0], tz = d[2] / d[0];
  const float width = footprint_m * std::sqrt(1 + ty * ty), height = footprint_m * std::sqrt(1 + tz * tz);
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
