#include "incognita/world/rendered/render.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/math/quaternion.hpp"
#include "incognita/world/rendered/plane.hpp"

namespace incognita {
namespace {

using Direction = std::array<float, 3>;  ///< world axes, not normalized
using BoxBits = std::uint32_t;           ///< one bit per box of the room

constexpr int tile_px = RayTable::tile_px;
constexpr float white_gray = 236, black_gray = 14;  // gray levels of the sheet
constexpr int sheet_wall = 1;                       // at the upper end of x
constexpr int floor_wall = 4;                       // at the lower end of z
constexpr std::uint8_t nothing = 255;               // id if no surface is visible

struct Hit {
  float t = std::numeric_limits<float>::max();  ///< ray parameter
  int surface = 0;                              ///< 2 * axis + side
  int box = -1;                                 ///< -1: the room itself
};

struct Bounds {  ///< box relative to the camera
  std::array<float, 3> min, max;
};

/// What is visible in a tile.
struct TileView {
  BoxBits boxes = 0;
  int wall = -1;        ///< the only visible wall, if there is just one and no box
  bool sheet = false;   ///< whether the sheet may be visible
  bool ground = false;  ///< whether uneven ground may be visible
};

/// What is visible in one of two views.
TileView either(const TileView& a, const TileView& b) {
  return {a.boxes | b.boxes, a.wall == b.wall ? a.wall : -1, a.sheet || b.sheet, a.ground || b.ground};
}

/// What a ray meets.
struct VisibleParts {
  std::uint8_t id = nothing;  ///< surface id
  float nearness = 0;  ///< on uneven ground: 1 / ray parameter, which is affine over the pixels of a plane
};

inline int lit(int gray, const RoomSurface& surface) {
  return std::min(static_cast<int>(static_cast<float>(gray) * surface.light), 255 * 256);
}

inline std::uint8_t rounded(int gray_256) { return static_cast<std::uint8_t>((gray_256 + 128) >> 8); }

/// Fraction of a pixel's width, centered at `x`, within +-half.
float share_within(float x, float half, float width) {
  const float low = std::max(x - 0.5f * width, -half), high = std::min(x + 0.5f * width, half);
  return std::max(0.0f, high - low) / width;
}

/// Renders one image; holds all that is the same for the pixels of a row.
class Picture {
 public:
  /// `poses`: one for all rows, or one per row.
  Picture(const Room& room, const RayTable& rays, std::span<const RigidPose> poses);

  void draw(Image& out);

 private:
  bool moves() const { return poses_.size() > 1; }
  void place(const RigidPose& world_from_camera);
  void see_tiles(int tile_row);
  Bounds relative(const Box& box) const;
  Direction turned(float x, float y, float z = 1) const {
    return {r_[0] * x + r_[1] * y + r_[2] * z, r_[3] * x + r_[4] * y + r_[5] * z,
            r_[6] * x + r_[7] * y + r_[8] * z};
  }
  float distance_to(const Hit& hit) const;

  TileView view_of(const RayTable::Cone& cone) const;
  bool only_wall(int wall, const Direction& axis, float sin_half_angle) const;

  void draw_rays(std::size_t first, int count, const TileView& view, std::uint8_t* pixels);
  void draw_wall(std::size_t first, int count, const TileView& view, std::uint8_t* pixels);
  void smooth_edges(Image& out);
  bool on_edge(std::size_t at) const;
  bool on_crest(std::size_t at) const;
  int mean_of_four(std::size_t at, const TileView& view) const;

  int gray(float x, float y, float footprint, const TileView& view, VisibleParts& visible) const;
  int ground_gray(const Direction& d, float t, float footprint) const;
  Hit leave_room(const Direction& d, const Direction& inverse) const;
  void enter_boxes(const Direction& d, const Direction& inverse, BoxBits boxes, Hit& hit) const;
  int with_sheet(int wall, const Direction& d, float footprint) const;

  const Room& room_;
  const RayTable& rays_;
  std::span<const RigidPose> poses_;
  // of the row being drawn:
  Eigen::Vector3d position_;
  std::array<float, 9> r_;  ///< world_from_camera, row by row
  Direction eye_;           ///< camera position, m
  Bounds inside_, sheet_, ground_;
  std::vector<Bounds> boxes_;
  // of the image:
  std::vector<TileView> tiles_;
  std::vector<std::uint8_t> ids_;  ///< surface visible in each pixel
  /// Inverse ray parameter of the uneven ground in each pixel; empty for a level floor.
  std::vector<float> nearness_;
};

Picture::Picture(const Room& room, const RayTable& rays, std::span<const RigidPose> poses)
    : room_(room), rays_(rays), poses_(poses), ids_(rays.x.size(), nothing) {
  if (room.ground()) nearness_.assign(rays.x.size(), 0);
  place(poses.front());
  tiles_.reserve(rays.cones.size());
  for (int row = 0; row < rays.tiles_down; ++row) see_tiles(row);
}

/// Puts the camera where it is while it exposes a row.
void Picture::place(const RigidPose& world_from_camera) {
  const Eigen::Matrix3d r = rotation_matrix<double>(world_from_camera.world_from_body);
  position_ = world_from_camera.position;
  for (int i = 0; i < 9; ++i) r_[i] = static_cast<float>(r(i / 3, i % 3));
  inside_ = relative(room_.layout().inside);
  for (int i = 0; i < 3; ++i) eye_[i] = static_cast<float>(position_[i]);
  if (const Ground* ground = room_.ground()) {
    Box bounds = room_.layout().inside;
    bounds.max.z() = ground->highest_m();
    ground_ = relative(bounds);
  }
  const Sheet& sheet = room_.layout().sheet;
  const Eigen::Vector3d half(0, sheet.width / 2, sheet.height / 2), middle(sheet.x, sheet.y, sheet.z);
  sheet_ = relative({middle - half, middle + half});
  boxes_.clear();
  for (const Box& box : room_.layout().boxes) boxes_.push_back(relative(box));
}

/// What is visible in a row of tiles from its first or its last row of pixels. Between them a camera moves by a fraction
/// of a pixel, which is within the margin of the cones.
void Picture::see_tiles(int tile_row) {
  const std::size_t first = static_cast<std::size_t>(tile_row) * rays_.tiles_across;
  const auto see = [&](int u) { return view_of(rays_.cones[first + u]); };
  if (moves()) place(poses_[tile_row * tile_px]);
  for (int u = 0; u < rays_.tiles_across; ++u) tiles_.push_back(see(u));
  if (!moves()) return;
  place(poses_[std::min((tile_row + 1) * tile_px, rays_.height) - 1]);
  for (int u = 0; u < rays_.tiles_across; ++u) tiles_[first + u] = either(tiles_[first + u], see(u));
}

Bounds Picture::relative(const Box& box) const {
  Bounds b;
  for (int i = 0; i < 3; ++i) {
    b.min[i] = static_cast<float>(box.min[i] - position_[i]);
    b.max[i] = static_cast<float>(box.max[i] - position_[i]);
  }
  return b;
}

/// A ray in the cone that meets the box passes it no farther from the cone's axis than the box's far end
/// times the sine of the half angle, so the axis meets the box grown by that margin. Conservative.
bool may_meet(const Bounds& box, const Direction& axis, float sin_half_angle) {
  float reach_squared = 0, enter = 0, leave = std::numeric_limits<float>::max();
  for (int i = 0; i < 3; ++i) reach_squared += std::max(box.min[i] * box.min[i], box.max[i] * box.max[i]);
  const float margin = std::sqrt(reach_squared) * sin_half_angle;
  for (int i = 0; i < 3; ++i) {
    const float low = (box.min[i] - margin) / axis[i], high = (box.max[i] + margin) / axis[i];
    enter = std::max(enter, std::min(low, high));
    leave = std::min(leave, std::max(low, high));
  }
  return enter <= leave || sin_half_angle >= 1;
}

TileView Picture::view_of(const RayTable::Cone& cone) const {
  const Direction axis = turned(cone.axis.x(), cone.axis.y(), cone.axis.z());
  TileView view;
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    if (may_meet(boxes_[i], axis, cone.sin_half_angle)) view.boxes |= BoxBits{1} << i;
  view.sheet = may_meet(sheet_, axis, cone.sin_half_angle);
  view.ground = room_.ground() && may_meet(ground_, axis, cone.sin_half_angle);
  const int wall = leave_room(axis, {1 / axis[0], 1 / axis[1], 1 / axis[2]}).surface;
  if (!view.boxes && !view.ground && only_wall(wall, axis, cone.sin_half_angle)) view.wall = wall;
  return view;
}

/// Whether a cone lies within the four planes through the camera and the edges of a wall.
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
  for (int v = 0; v < rays_.height; ++v) {
    if (moves()) place(poses_[v]);
    for (int tile = 0; tile < rays_.tiles_across; ++tile) {
      const TileView& view = tiles_[v / tile_px * rays_.tiles_across + tile];
      const int u = tile * tile_px, count = std::min(tile_px, rays_.width - u);
      if (view.wall >= 0)
        draw_wall(rays_.index(u, v), count, view, out.row(v) + u);
      else
        draw_rays(rays_.index(u, v), count, view, out.row(v) + u);
    }
  }
  smooth_edges(out);
}

void Picture::draw_rays(std::size_t first, int count, const TileView& view, std::uint8_t* pixels) {
  for (int i = 0; i < count; ++i) {
    const std::size_t at = first + i;
    VisibleParts visible;
    pixels[i] = 0;
    if (rays_.footprint[at] > 0)
      pixels[i] = rounded(gray(rays_.x[at], rays_.y[at], rays_.footprint[at], view, visible));
    ids_[at] = visible.id;
    if (view.ground) nearness_[at] = visible.nearness;
  }
}

/// Fast path for tiles that see only one wall: computes a row of pixels at once.
void Picture::draw_wall(std::size_t first, int count, const TileView& view, std::uint8_t* pixels) {
  const RoomSurface& surface = room_.walls()[view.wall];
  const Plane plane(surface, view.wall / 2, distance_to({0, view.wall, -1}), position_);
  const auto covered = plane.covered<tile_px>(r_, &rays_.x[first], &rays_.y[first], &rays_.footprint[first]);
  for (int i = 0; i < count; ++i) {
    const std::size_t at = first + i;
    pixels[i] = 0;
    if (!(rays_.footprint[at] > 0)) continue;
    int gray = sample(surface.texture, covered, i);
    if (view.sheet && view.wall == sheet_wall)
      gray = with_sheet(gray, turned(rays_.x[at], rays_.y[at]), rays_.footprint[at]);
    pixels[i] = rounded(lit(gray, surface));
    ids_[at] = static_cast<std::uint8_t>(view.wall);
  }
}

/// Antialiasing: the mipmaps smooth the textures, so steps appear only where two surfaces meet. Only those pixels are
/// supersampled with four rays. Tiles that see only one wall contain none, not even at their borders.
void Picture::smooth_edges(Image& out) {
  for (int v = 1; v < rays_.height - 1; ++v) {
    if (moves()) place(poses_[v]);
    for (int tile = 0; tile < rays_.tiles_across; ++tile) {
      const TileView& view = tiles_[v / tile_px * rays_.tiles_across + tile];
      if (view.wall >= 0) continue;
      const int begin = std::max(1, tile * tile_px), end = std::min((tile + 1) * tile_px, rays_.width - 1);
      for (int u = begin; u < end; ++u)
        if (const std::size_t at = rays_.index(u, v); on_edge(at) || (view.ground && on_crest(at)))
          out(u, v) = rounded(mean_of_four(at, view));
    }
  }
}

bool Picture::on_edge(std::size_t at) const {
  const std::uint8_t* id = &ids_[at];
  const std::array<std::uint8_t, 4> around{id[1], id[-1], id[rays_.stride], id[-rays_.stride]};
  const bool same = id[0] == around[0] && id[0] == around[1] && id[0] == around[2] && id[0] == around[3];
  return !same && id[0] != nothing && std::find(around.begin(), around.end(), nothing) == around.end();
}

/// Occlusion edges of the ground, where both sides are the same surface.
bool Picture::on_crest(std::size_t at) const {
  constexpr float share = 0.01f;
  const float* n = &nearness_[at];
  const float left = n[-1], right = n[1], above = n[-rays_.stride], below = n[rays_.stride];
  if (!(std::min({n[0], left, right, above, below}) > 0)) return false;
  return std::max(std::abs(left + right - 2 * n[0]), std::abs(above + below - 2 * n[0])) > share * n[0];
}

int Picture::mean_of_four(std::size_t at, const TileView& view) const {
  const float *x = &rays_.x[at], *y = &rays_.y[at];
  const int down = rays_.stride;
  const float xu = 0.125f * (x[1] - x[-1]), yu = 0.125f * (y[1] - y[-1]);  // a quarter pixel
  const float xv = 0.125f * (x[down] - x[-down]), yv = 0.125f * (y[down] - y[-down]);
  VisibleParts visible;
  int sum = 0;
  for (const auto& [du, dv] : {std::pair(-1.f, -1.f), {1.f, -1.f}, {-1.f, 1.f}, {1.f, 1.f}})
    sum += gray(*x + du * xu + dv * xv, *y + du * yu + dv * yv, 0.6f * rays_.footprint[at], view, visible);
  return sum / 4;
}

/// The floor's texture where a ray along `d` meets uneven ground at `t`, projected and lit from above.
int Picture::ground_gray(const Direction& d, float t, float footprint) const {
  constexpr float lamp_x = 0.35f, lamp_y = 0.2f;  // light direction, relative to its upward component
  const RoomSurface& floor = room_.walls()[floor_wall];
  const float x = eye_[0] + t * d[0], y = eye_[1] + t * d[1];
  const Ground::HeightAndSlope at = room_.ground()->at(x, y);
  // As Plane::covered with the local slope: the closing rate takes the place of the normal component
  const float closing = std::max(at.slope_x * d[0] + at.slope_y * d[1] - d[2], 1e-3f);
  const float footprint_m = t * footprint, stretch = footprint_m / closing;
  const Covered<1> covered{{x * floor.u_per_m + floor.u_at_0},
                           {y * floor.v_per_m + floor.v_at_0},
                           {std::clamp(stretch * d[0] * floor.u_per_m, -1e5f, 1e5f)},
                           {std::clamp(stretch * d[1] * floor.v_per_m, -1e5f, 1e5f)},
                           {footprint_m * std::abs(floor.v_per_m)}};
  const float upright = 1 / std::sqrt(1 + at.slope_x * at.slope_x + at.slope_y * at.slope_y);
  const float light = std::clamp((1 - lamp_x * at.slope_x - lamp_y * at.slope_y) * upright, 0.3f, 1.3f);
  return lit(static_cast<int>(static_cast<float>(sample(floor.texture, covered, 0)) * light), floor);
}

/// 256 times the gray level that a ray sees; sets `visible` to what it meets.
inline int Picture::gray(float x, float y, float footprint, const TileView& view,
                         VisibleParts& visible) const {
  const Direction d = turned(x, y), inverse{1.0f / d[0], 1.0f / d[1], 1.0f / d[2]};
  Hit hit = leave_room(d, inverse);
  if (view.boxes) enter_boxes(d, inverse, view.boxes, hit);
  if (view.ground) {
    if (const float t = room_.ground()->meet(eye_, d, hit.t); t < hit.t) {
      visible = {floor_wall, 1 / t};
      return ground_gray(d, t, footprint);
    }
  }
  visible = {static_cast<std::uint8_t>((hit.box + 1) * 6 + hit.surface), 0};
  const RoomSurface& surface = (hit.box < 0 ? room_.walls() : room_.box_surfaces(hit.box))[hit.surface];
  const Plane plane(surface, hit.surface / 2, distance_to(hit), position_);
  const int paint = sample(surface.texture, plane.covered<1>(r_, &x, &y, &footprint), 0);
  const bool sheet = view.sheet && hit.box < 0 && hit.surface == sheet_wall;
  return lit(sheet ? with_sheet(paint, d, footprint) : paint, surface);
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

/// Intersects the ray with the boxes and keeps the nearest hit.
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

/// The sheet is rendered analytically instead of as a texture, so that its corners are as sharp as the camera
/// can resolve.
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
  const float sheet = white_gray + ink * (black_gray - white_gray);
  return static_cast<int>(static_cast<float>(wall) * (1 - paper) + 256 * sheet * paper);
}

}  // namespace

void render(const Room& room, const RayTable& rays, std::span<const RigidPose> row_poses, Image& out) {
  const std::size_t rows = static_cast<std::size_t>(rays.height);
  if (row_poses.size() != 1 && row_poses.size() != rows)
    throw std::invalid_argument("an image is rendered from one pose, or from one per row, " +
                                std::to_string(rows) + "; got " + std::to_string(row_poses.size()));
  if (out.width() != rays.width || out.height() != rays.height) out = Image(rays.width, rays.height);
  const auto sees_nothing = [&](const RigidPose& pose) {
    const Ground* ground = room.ground();
    const Eigen::Vector3f at = pose.position.cast<float>();
    const bool buried = ground && !(at.z() > ground->at(at.x(), at.y()).height);
    return buried || !room.layout().inside.contains(pose.position);
  };
  if (std::ranges::any_of(row_poses, sees_nothing))
    out = Image(rays.width, rays.height);
  else
    Picture(room, rays, row_poses).draw(out);
}

void render(const Room& room, const RayTable& rays, const Eigen::Vector3d& position,
            const Eigen::Vector4d& world_from_camera, Image& out) {
  const RigidPose pose{position, world_from_camera};
  render(room, rays, {&pose, 1}, out);
}

}  // namespace incognita
