#include "incognita/world/rendered/room_layout.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/messages/unfit_setting.hpp"

namespace incognita {
namespace {

constexpr int max_boxes = 24;            // the renderer uses one bit per box
constexpr double max_side_m = 50;        // beyond, texels would be too coarse for corner detection
constexpr double gap_m = 0.25;           // between boxes, so that their silhouettes are distinct
constexpr double corridor_half_m = 1.0;  // free on both sides of the line from the start to the target
constexpr int tries_per_box = 500;

void need(bool ok, const char* what, double value) {
  if (!ok) throw std::invalid_argument(std::string(what) + ", got " + std::to_string(value));
}

void check(const RoomSettings& s) {
  need(s.size_m.x() >= 2 && s.size_m.x() <= max_side_m, "room size_m x must be 2 to 50", s.size_m.x());
  need(s.size_m.y() >= 2 && s.size_m.y() <= max_side_m, "room size_m y must be 2 to 50", s.size_m.y());
  need(s.size_m.z() >= 1.8 && s.size_m.z() <= 20, "room size_m z must be 1.8 to 20", s.size_m.z());
  need(s.boxes >= 0 && s.boxes <= max_boxes, "room boxes must be 0 to 24", s.boxes);
  need(s.clearance_m >= 0 && s.clearance_m <= 0.5, "room clearance_m must be 0 to 0.5", s.clearance_m);
}

bool overlap_on_floor(const Box& a, const Box& b) {
  return a.min.x() < b.max.x() && b.min.x() < a.max.x() && a.min.y() < b.max.y() && b.min.y() < a.max.y();
}

/// Keeps the line of sight from the start to the target free, with space to move.
Box corridor(const RoomSettings& s, const Sheet& sheet) {
  const Eigen::Vector3d start = s.start_position_m;
  const double h = corridor_half_m;
  return {{std::min(start.x(), sheet.x) - 0.6, std::min(start.y(), sheet.y) - h, 0},
          {std::max(start.x(), sheet.x), std::max(start.y(), sheet.y) + h, s.size_m.z()}};
}

/// A box with its back to a random wall.
Box box_along_wall(const RoomSettings& s, RandomStream& random) {
  const double width = random.uniform(0.35, 0.8), depth = random.uniform(0.3, 0.6);
  const double height = std::min(random.uniform(0.4, 1.5), s.size_m.z() - 0.5);
  const int wall = random.below(4);
  const int normal = wall / 2, along = 1 - normal;
  const double half = s.size_m[along] / 2, back = s.size_m[normal] / 2;
  const double left = random.uniform(-half, half - width);
  Box box;
  box.max.z() = height;
  box.min[along] = left;
  box.max[along] = left + width;
  box.min[normal] = wall % 2 ? back - depth : -back;
  box.max[normal] = wall % 2 ? back : depth - back;
  return box;
}

}  // namespace

std::array<Eigen::Vector3d, 4> Sheet::corners() const {
  const double w = black_width / 2, h = black_height / 2;  // facing +x, left is +y
  return {Eigen::Vector3d(x, y + w, z + h), Eigen::Vector3d(x, y - w, z + h),
          Eigen::Vector3d(x, y - w, z - h), Eigen::Vector3d(x, y + w, z - h)};
}

RoomLayout room_layout(const RoomSettings& s, std::uint64_t seed) {
  check(s);
  RoomLayout layout;
  layout.inside = {{-s.size_m.x() / 2, -s.size_m.y() / 2, 0},
                   {s.size_m.x() / 2, s.size_m.y() / 2, s.size_m.z()}};
  layout.sheet.x = layout.inside.max.x();
  RandomStream random(seed, "room.layout");
  const Box keep_free = corridor(s, layout.sheet);
  for (int tries = 0; static_cast<int>(layout.boxes.size()) < s.boxes; ++tries) {
    if (tries == tries_per_box * (s.boxes + 1))
      throw UnfitSetting({"room.boxes", "room.size_m", "run.seed"},
                         "that many boxes do not fit along the walls of the room; take fewer");
    const Box box = box_along_wall(s, random);
    const auto touches = [&](const Box& other) { return overlap_on_floor(box.grown(gap_m), other); };
    const bool taken = std::any_of(layout.boxes.begin(), layout.boxes.end(), touches);
    if (!taken && !overlap_on_floor(box, keep_free)) layout.boxes.push_back(box);
  }
  return layout;
}

}  // namespace incognita
