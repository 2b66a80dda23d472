#include "incognita/world/rendered/free_camera_plant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "incognita/models/motion/heading.hpp"
#include "incognita/world/integrate.hpp"

namespace incognita {
namespace {

using Input = FreeCameraMotion::Input<double>;

// The body may be pushed from one obstacle into another; what then remains is resolved in the next tick
constexpr int passes = 4;

void check_sigma(double sigma, const char* what) {
  if (!(sigma >= 0 && std::isfinite(sigma)))
    throw std::invalid_argument(std::string(what) + " must be zero or positive, got " +
                                std::to_string(sigma));
}

void check_settings(const RoomSettings& s) {
  check_sigma(s.sigma_start_position_m, "room sigma_start_position_m");
  check_sigma(s.sigma_start_heading_rad, "room sigma_start_heading_rad");
  check_sigma(s.sigma_acceleration_m_s2, "room sigma_acceleration_m_s2");
  check_sigma(s.sigma_angular_acceleration_rad_s2, "room sigma_angular_acceleration_rad_s2");
}

std::vector<Box> grown(std::vector<Box> boxes, double margin_m) {
  for (Box& box : boxes) box = box.grown(margin_m);
  return boxes;
}

FreeCameraPlant::State draw_start(const RoomSettings& s, std::uint64_t seed) {
  RandomStream random(seed, "world.start");
  FreeCameraPlant::State x = FreeCameraPlant::State::Zero();
  for (int i = 0; i < 3; ++i) x[i] = s.start_position_m[i] + s.sigma_start_position_m * random.normal();
  x.segment<4>(3) = level_gaze(s.start_heading_rad + s.sigma_start_heading_rad * random.normal());
  return x;
}

std::string text(const Eigen::Vector3d& p) {
  return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ")";
}

}  // namespace

FreeCameraPlant::FreeCameraPlant(const RoomSettings& s, const RoomLayout& layout, std::uint64_t seed)
    : inside_(layout.inside.grown(-s.clearance_m)),
      boxes_(grown(layout.boxes, s.clearance_m)),
      sigma_acceleration_m_s2_(s.sigma_acceleration_m_s2),
      sigma_angular_acceleration_rad_s2_(s.sigma_angular_acceleration_rad_s2),
      disturbance_(seed, "world.disturbance") {
  check_settings(s);
  if (!inside_.contains(s.start_position_m))
    throw std::invalid_argument(
        "room start_position_m must lie in the room, clearance_m from its walls, got " +
        text(s.start_position_m));
  state_ = draw_start(s, seed);
  stop_at_obstacles(s.start_position_m);
}

const FreeCameraPlant::State& FreeCameraPlant::move(Input u, double dt_s) {
  if (!u.allFinite()) throw std::invalid_argument("the command to the camera is not finite");
  if (!(dt_s >= 0 && std::isfinite(dt_s)))
    throw std::invalid_argument("a tick must last zero or more seconds, got " + std::to_string(dt_s));
  if (dt_s == 0) return state_;
  for (int i = 0; i < 3; ++i) u[i] += sigma_acceleration_m_s2_ * disturbance_.normal();
  for (int i = 3; i < 6; ++i) u[i] += sigma_angular_acceleration_rad_s2_ * disturbance_.normal();
  const Eigen::Vector3d before = state_.head<3>();
  state_ = integrate(FreeCameraMotion{}, state_, u, dt_s);
  stop_at_obstacles(before);
  return state_;
}

void FreeCameraPlant::stop_at_obstacles(const Eigen::Vector3d& before) {
  for (int i = 0; i < 3; ++i) {
    const double clamped = std::clamp(state_[i], inside_.min[i], inside_.max[i]);
    if (clamped < state_[i]) state_[7 + i] = std::min(0.0, state_[7 + i]);
    if (clamped > state_[i]) state_[7 + i] = std::max(0.0, state_[7 + i]);
    state_[i] = clamped;
  }
  bool moved = true;
  for (int pass = 0; pass < passes && moved; ++pass) {
    moved = false;
    for (const Box& box : boxes_) moved |= stop_at_box(box, before);
  }
}

/// Stops the body at the face through which its motion enters the box, and lets it slide along that face.
bool FreeCameraPlant::stop_at_box(const Box& box, const Eigen::Vector3d& before) {
  const Eigen::Vector3d way = state_.head<3>() - before;
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
  state_[axis] = up ? box.min[axis] : box.max[axis];
  state_[7 + axis] = up ? std::min(0.0, state_[7 + axis]) : std::max(0.0, state_[7 + axis]);
  return true;
}

}  // namespace incognita
