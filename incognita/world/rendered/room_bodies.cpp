#include "incognita/world/rendered/room_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

// The body may be pushed from one obstacle into another; what then remains is resolved in the next tick
constexpr int passes = 4;

void check_sigma(double sigma, const char* what) {
  if (!(sigma >= 0 && std::isfinite(sigma)))
    throw std::invalid_argument(std::string(what) + " must be zero or positive, got " +
                                std::to_string(sigma));
}

std::vector<Box> grown(std::vector<Box> boxes, double margin_m) {
  for (Box& box : boxes) box = box.grown(margin_m);
  return boxes;
}

FreeCameraMotion::State<double> at_rest(const Eigen::Vector3d& position, double heading_rad) {
  FreeCameraMotion::State<double> x = FreeCameraMotion::State<double>::Zero();
  x.head<3>() = position;
  x.segment<4>(3) = level_gaze(heading_rad);
  return x;
}

/// Drawn in world axes, where the plant would draw in camera axes.
FreeCameraMotion::State<double> draw_start(const RoomSettings& s, std::uint64_t seed) {
  RandomStream random(seed, "world.start");
  Eigen::Vector3d position;
  for (int i = 0; i < 3; ++i)
    position[i] = s.start_position_m[i] + s.sigma_start_position_m * random.normal();
  return at_rest(position, s.start_heading_rad + s.sigma_start_heading_rad * random.normal());
}

std::string text(const Eigen::Vector3d& p) {
  return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ")";
}

/// Ends the motion beyond `limit` along an axis. `up`: the body comes from below.
void stop_axis(SmallVector& state, int axis, double limit, bool up) {
  state[axis] = limit;
  state[7 + axis] = up ? std::min(0.0, state[7 + axis]) : std::max(0.0, state[7 + axis]);
}

}  // namespace

CameraObstacles::CameraObstacles(const RoomLayout& layout, double clearance_m)
    : inside_(layout.inside.grown(-clearance_m)), boxes_(grown(layout.boxes, clearance_m)) {}

void CameraObstacles::check_start(const SmallVector& state) const {
  const Eigen::Vector3d position = state.head<3>();
  if ((position.array() < inside_.min.array()).any() || (position.array() > inside_.max.array()).any())
    throw std::invalid_argument(
        "room start_position_m must lie in the room, clearance_m from its walls, got " + text(position));
}

bool CameraObstacles::stop(const SmallVector& before, SmallVector& state) const {
  bool stopped = false;
  for (int i = 0; i < 3; ++i) {
    const double clamped = std::clamp(state[i], inside_.min[i], inside_.max[i]);
    if (clamped == state[i]) continue;
    stop_axis(state, i, clamped, clamped < state[i]);
    stopped = true;
  }
  bool moved = true;
  for (int pass = 0; pass < passes && moved; ++pass) {
    moved = false;
    for (const Box& box : boxes_) moved |= stop_at_box(box, before.head<3>(), state);
    stopped |= moved;
  }
  return stopped;
}

/// Stops the body at the face through which its motion enters the box, and lets it slide along that face.
bool CameraObstacles::stop_at_box(const Box& box, const Eigen::Vector3d& before, SmallVector& state) const {
  const Eigen::Vector3d way = state.head<3>() - before;
  double enter = -1, leave = 1;
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (way[i] == 0) {
      if (before[i] <= box.min[i] || before[i] >= box.max[i]) return false;
      continue;
    }
    const double near = (way[i] > 0 ? box.min[i] : box.max[i]) - before[i];
    const double far = (way[i] > 0 ? box.max[i] : box.min[i]) - before[i];
    if (near / way[i] > enter) {
      enter = near / way[i];
      axis = i;
    }
    leave = std::min(leave, far / way[i]);
  }
  if (axis < 0 || enter < 0 || enter >= leave) return false;
  const bool up = way[axis] > 0;
  stop_axis(state, axis, up ? box.min[axis] : box.max[axis], up);
  return true;
}

void VehicleObstacles::check_start(const SmallVector& state) const {
  const double free_m = plan_.clearance_at(state.head<2>());
  if (free_m < radius_m_)
    throw UnfitSetting({"start.positions_m", "room.boxes", "room.clearance_m", "run.seed"},
                       "the vehicle starts " + std::to_string(free_m) +
                           " m from a wall or a box, but needs " + std::to_string(radius_m_) +
                           " m (room.clearance_m): move its start, or change room.boxes");
}

bool VehicleObstacles::stop(const SmallVector& before, SmallVector& state) const {
  const double free_m = plan_.clearance_at(state.head<2>());
  if (free_m >= radius_m_ || free_m >= plan_.clearance_at(before.head<2>())) return false;
  state.head<2>() = before.head<2>();
  return true;
}

SimulatedBody camera_in_room(const RoomSettings& s, const RoomLayout& layout, std::uint64_t seed) {
  check_sigma(s.sigma_start_position_m, "room sigma_start_position_m");
  check_sigma(s.sigma_start_heading_rad, "room sigma_start_heading_rad");
  constexpr int inputs = FreeCameraMotion::input_size;
  const auto obstacles = std::make_shared<CameraObstacles>(layout, s.clearance_m);
  const SmallVector nominal = at_rest(s.start_position_m, s.start_heading_rad);
  obstacles->check_start(nominal);
  PlantSettings plant;
  plant.start = draw_start(s, seed);
  obstacles->stop(nominal, plant.start);
  plant.start_sigmas = SmallVector::Zero(FreeCameraMotion::error_size);
  plant.input_sigmas = SmallVector::Constant(inputs, s.sigma_acceleration_m_s2);
  plant.input_sigmas.tail<3>().setConstant(s.sigma_angular_acceleration_rad_s2);
  plant.most_input = SmallVector::Constant(inputs, std::numeric_limits<double>::max());
  plant.least_input = -plant.most_input;
  SimulatedBody body{FreeCameraMotion{}, plant, "world"};
  body.obstacles = obstacles;
  return body;
}

SimulatedBody vehicle_in_room(const TerrainVehicle& vehicle, const Mount& mount, const PlantSettings& plant,
                              const RoomLayout& layout, double radius_m) {
  SimulatedBody body{vehicle, plant, "vehicle", mount};
  body.obstacles = std::make_shared<VehicleObstacles>(layout, radius_m);
  return body;
}

}  // namespace incognita
