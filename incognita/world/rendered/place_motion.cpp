#include "incognita/world/rendered/place_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

using Eigen::Vector3d;

constexpr double step_m = 0.1;    // between the starts that are tried
constexpr double smaller = 0.95;  // ratio of the scales that are tried
constexpr double least_scale = 0.05;
/// Beyond the clearance, in the order in which they are tried: real cameras seldom come as near to walls as they could.
constexpr double further_away_m[] = {0.45, 0.2, 0};

Eigen::Vector4d about_vertical(double turn_rad) { return quaternion_exp<double>(Vector3d(0, 0, turn_rad)); }

/// Whether the line from a to b meets a box.
bool meets(const Box& box, const Vector3d& a, const Vector3d& b) {
  double enter = 0, leave = 1;
  for (int i = 0; i < 3; ++i) {
    const double way = b[i] - a[i], low = box.min[i] - a[i], high = box.max[i] - a[i];
    if (way == 0) {
      if (low >= 0 || high <= 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / way, high / way));
    leave = std::min(leave, std::max(low / way, high / way));
  }
  return enter < leave;
}

/// The space for the camera, and the way that it takes from its start, m.
struct Search {
  Box inside;
  std::vector<Box> boxes;
  std::vector<Vector3d> way;

  void keep_away(const RoomLayout& layout, double clearance_m) {
    inside = layout.inside.grown(-clearance_m);
    boxes.clear();
    for (const Box& box : layout.boxes) boxes.push_back(box.grown(clearance_m));
  }

  bool is_free(const Vector3d& start, double scale) const {
    for (const Box& box : boxes)
      for (std::size_t k = 0; k + 1 < way.size(); ++k)
        if (meets(box, start + scale * way[k], start + scale * way[k + 1])) return false;
    return true;
  }

  /// The start that is free and nearest to the wanted one, of those on a grid through it.
  std::optional<Vector3d> start(double scale, const Vector3d& wanted) const;
};

/// Offsets 0, step, -step, 2 step, ... that keep a coordinate within its bounds.
std::vector<double> offsets(double at, double least, double most) {
  std::vector<double> all{0};
  const int count = static_cast<int>((most - least) / step_m) + 1;
  for (int i = 1; i <= count; ++i)
    for (const double offset : {i * step_m, -i * step_m})
      if (at + offset >= least && at + offset <= most) all.push_back(offset);
  return all;
}

std::optional<Vector3d> Search::start(double scale, const Vector3d& wanted) const {
  Vector3d least_way = Vector3d::Zero(), most_way = Vector3d::Zero();
  for (const Vector3d& w : way) least_way = least_way.cwiseMin(w), most_way = most_way.cwiseMax(w);
  const Vector3d least = inside.min - scale * least_way, most = inside.max - scale * most_way;
  if ((least.array() > most.array()).any()) return std::nullopt;
  const Vector3d center = wanted.cwiseMax(least).cwiseMin(most);
  std::vector<Vector3d> tries;
  for (const double x : offsets(center.x(), least.x(), most.x()))
    for (const double y : offsets(center.y(), least.y(), most.y()))
      for (const double z : offsets(center.z(), least.z(), most.z())) tries.emplace_back(x, y, z);
  std::ranges::stable_sort(tries, {}, [](const Vector3d& offset) { return offset.squaredNorm(); });
  for (const Vector3d& offset : tries)
    if (is_free(center + offset, scale)) return center + offset;
  return std::nullopt;
}

}  // namespace

TimedPose MotionPlacement::of(const TimedPose& pose) const {
  const Eigen::Vector4d turn = about_vertical(turn_rad);
  return {pose.t,
          {start + scale * rotation_matrix<double>(turn) * (pose.pose.position - origin),
           quaternion_product<double>(turn, pose.pose.world_from_body)}};
}

MotionPlacement place_motion(const std::vector<TimedPose>& motion, const RoomLayout& layout,
                             double clearance_m, const WantedStart& wanted) {
  if (motion.empty()) throw std::invalid_argument("a motion without poses cannot be placed");
  const RigidPose& first = motion.front().pose;
  MotionPlacement placement{1, wanted.heading_rad - heading_of(first.world_from_body), first.position, {}};
  Search search;
  for (const TimedPose& pose : motion) search.way.push_back(placement.of(pose).pose.position);
  for (; placement.scale >= least_scale; placement.scale *= smaller)
    for (const double more_m : further_away_m) {
      search.keep_away(layout, clearance_m + more_m);
      const auto start = search.start(placement.scale, wanted.position);
      if (!start) continue;
      placement.start = *start;
      return placement;
    }
  throw UnfitSetting(
      {"motion.file", "room.size_m", "room.boxes", "room.clearance_m", "motion.start_s"},
      "the motion does not fit into the room, not even at a twentieth of its size: take a larger room, "
      "fewer boxes, or a shorter part (motion.start_s, run.duration_s)");
}

}  // namespace incognita
