#include "incognita/world/rendered/surface_patches.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/world/rendered/floor_plan.hpp"
#include "incognita/world/rendered/plane.hpp"
#include "incognita/world/rendered/room_ray.hpp"

namespace incognita {
namespace {

constexpr double sample_m = 0.1;                    // between the points at which visibility is found
constexpr double least_share = 0.5;                 // of a patch, that must be visible
constexpr double least_sine = 0.17364817766693033;  // of 10 degrees, between ray and surface
constexpr double on_surface_m = 1e-3;
constexpr double grid_m = 0.5;  // of the grid of camera positions
constexpr int floor_side = 4;   // index of a side as of Surfaces

int parts_of(double length_m, double size_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / size_m)));
}

bool is_on_sheet(const Sheet& sheet, const Eigen::Vector3d& p) {
  return std::abs(p.x() - sheet.x) <= on_surface_m && std::abs(p.y() - sheet.y) <= sheet.width / 2 &&
         std::abs(p.z() - sheet.z) <= sheet.height / 2;
}

/// From one end to the other at equal steps of at most `grid_m`; the middle alone if there is no room.
std::vector<double> steps_between(double low, double high) {
  if (!(high > low)) return {(low + high) / 2};
  const int count = static_cast<int>(std::ceil((high - low) / grid_m));
  std::vector<double> steps;
  for (int i = 0; i <= count; ++i) steps.push_back(low + (high - low) * i / count);
  return steps;
}

}  // namespace

SurfacePatches::SurfacePatches(std::shared_ptr<const Room> room, const std::vector<Eigen::Vector3d>& cameras,
                               double size_m)
    : room_(std::move(room)) {
  if (!(size_m > 0))
    throw std::invalid_argument("the size of a patch must be positive, got " + std::to_string(size_m));
  add_sides(room_->layout().inside, true, size_m);
  for (const Box& box : room_->layout().boxes) add_sides(box, false, size_m);
  for (DividedSide& side : sides_) count_patches(side, cameras);
}

void SurfacePatches::add_sides(const Box& box, bool from_inside, double size_m) {
  for (int index = 0; index < 6; ++index) {
    const bool upper = index % 2;
    DividedSide side;
    side.axis = index / 2;
    side.at = (upper ? box.max : box.min)[side.axis];
    side.faces_up = upper != from_inside;
    side.is_ground = from_inside && index == floor_side && room_->ground();
    const int a = across_of[side.axis], b = down_of[side.axis];
    side.min = {box.min[a], box.min[b]};
    side.max = {box.max[a], box.max[b]};
    side.columns = parts_of(side.max.x() - side.min.x(), size_m);
    side.rows = parts_of(side.max.y() - side.min.y(), size_m);
    sides_.push_back(std::move(side));
  }
}

void SurfacePatches::count_patches(DividedSide& side, const std::vector<Eigen::Vector3d>& cameras) {
  const Eigen::Vector2d size = (side.max - side.min).array() / Eigen::Array2d(side.columns, side.rows);
  for (int row = 0; row < side.rows; ++row)
    for (int column = 0; column < side.columns; ++column) {
      const Eigen::Vector2d min = side.min + size.cwiseProduct(Eigen::Vector2d(column, row));
      const double area_m2 = area_that_counts(side, min, size, cameras);
      side.patches.push_back(area_m2 > 0 ? static_cast<int>(areas_m2_.size()) : -1);
      if (area_m2 > 0) areas_m2_.push_back(area_m2);
    }
}

/// Zero unless the patch counts.
double SurfacePatches::area_that_counts(const DividedSide& side, const Eigen::Vector2d& min,
                                        const Eigen::Vector2d& size,
                                        const std::vector<Eigen::Vector3d>& cameras) const {
  const int columns = static_cast<int>(std::ceil(size.x() / sample_m)),
            rows = static_cast<int>(std::ceil(size.y() / sample_m)), points = columns * rows;
  const Eigen::Vector2d step = size.array() / Eigen::Array2d(columns, rows);
  int visible = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d middle = min + step.cwiseProduct(Eigen::Vector2d(column + 0.5, row + 0.5));
      const Eigen::Vector3d point = point_on(side, middle);
      if (is_on_sheet(room_->layout().sheet, point) || !is_visible(side, point, cameras)) continue;
      ++visible;
    }
  return visible >= least_share * points ? size.prod() * visible / points : 0;
}

Eigen::Vector3d SurfacePatches::point_on(const DividedSide& side, const Eigen::Vector2d& at) const {
  Eigen::Vector3d point;
  point[side.axis] = side.at;
  point[across_of[side.axis]] = at.x();
  point[down_of[side.axis]] = at.y();
  if (side.is_ground)
    point.z() = room_->ground()->at(static_cast<float>(at.x()), static_cast<float>(at.y())).height;
  return point;
}

/// Towards the visible side.
Eigen::Vector3d SurfacePatches::normal_at(const DividedSide& side, const Eigen::Vector3d& point) const {
  if (!side.is_ground) return Eigen::Vector3d::Unit(side.axis) * (side.faces_up ? 1 : -1);
  const Ground::HeightAndSlope at =
      room_->ground()->at(static_cast<float>(point.x()), static_cast<float>(point.y()));
  return Eigen::Vector3d(-at.slope_x, -at.slope_y, 1).normalized();
}

bool SurfacePatches::is_visible(const DividedSide& side, const Eigen::Vector3d& point,
                                const std::vector<Eigen::Vector3d>& cameras) const {
  const Eigen::Vector3d normal = normal_at(side, point), before = point + on_surface_m * normal;
  const bool is_covered =  // by a box or a wall that touches it: most of what is not visible
      !room_->layout().inside.contains(before) ||
      std::ranges::any_of(room_->layout().boxes, [&](const Box& box) { return box.contains(before); });
  if (is_covered) return false;
  return std::ranges::any_of(cameras, [&](const Eigen::Vector3d& camera) {
    const Eigen::Vector3d ray = point - camera;
    if (-normal.dot(ray) < least_sine * ray.norm()) return false;
    constexpr double same_point_m =
        5 * on_surface_m;  // at a small angle the error of the height counts several times
    return (surface_point(*room_, camera, ray) - point).norm() < same_point_m;
  });
}

bool SurfacePatches::lies_on(const DividedSide& side, const Eigen::Vector3d& point) const {
  const Eigen::Vector2d at(point[across_of[side.axis]], point[down_of[side.axis]]);
  return std::abs(point_on(side, at)[side.axis] - point[side.axis]) <= on_surface_m &&
         (at.array() >= side.min.array() - on_surface_m).all() &&
         (at.array() <= side.max.array() + on_surface_m).all();
}

std::optional<std::size_t> SurfacePatches::patch_at(const Eigen::Vector3d& point) const {
  if (is_on_sheet(room_->layout().sheet, point)) return std::nullopt;
  for (const DividedSide& side : sides_) {
    if (!lies_on(side, point)) continue;
    const Eigen::Array2d at(point[across_of[side.axis]], point[down_of[side.axis]]);
    const Eigen::Array2d cell =
        (at - side.min.array()) / (side.max - side.min).array() * Eigen::Array2d(side.columns, side.rows);
    const int column = std::clamp(static_cast<int>(std::floor(cell.x())), 0, side.columns - 1),
              row = std::clamp(static_cast<int>(std::floor(cell.y())), 0, side.rows - 1);
    // Where two surfaces meet, the other one may count
    if (const int patch = side.patches[static_cast<std::size_t>(row * side.columns + column)]; patch >= 0)
      return static_cast<std::size_t>(patch);
  }
  return std::nullopt;
}

std::vector<Eigen::Vector3d> free_camera_positions(const Room& room, double clearance_m) {
  const Box inside = room.layout().inside.grown(-clearance_m);
  std::vector<Eigen::Vector3d> positions;
  for (const double x : steps_between(inside.min.x(), inside.max.x()))
    for (const double y : steps_between(inside.min.y(), inside.max.y()))
      for (const double z : steps_between(inside.min.z(), inside.max.z())) {
        const Eigen::Vector3d position(x, y, z);
        if (std::ranges::none_of(room.layout().boxes,
                                 [&](const Box& box) { return box.grown(clearance_m).contains(position); }))
          positions.push_back(position);
      }
  return positions;
}

std::vector<Eigen::Vector3d> carried_camera_positions(const Room& room, const Mount& mount,
                                                      double clearance_m) {
  const Box inside = room.layout().inside.grown(-clearance_m);
  const FloorPlan plan(room.layout());
  std::vector<Eigen::Vector3d> positions;
  for (const double x : steps_between(inside.min.x(), inside.max.x()))
    for (const double y : steps_between(inside.min.y(), inside.max.y())) {
      if (plan.clearance_at({x, y}) < clearance_m - on_surface_m) continue;
      const double ground_m =
          room.ground() ? room.ground()->at(static_cast<float>(x), static_cast<float>(y)).height : 0;
      positions.emplace_back(x, y, ground_m + mount.up_m);
    }
  return positions;
}

}  // namespace incognita
